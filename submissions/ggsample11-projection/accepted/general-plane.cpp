#include "GgApp.h"

// The light above the floor.
const GgVector lp{ 0.0f, 4.0f, 0.0f, 1.0f };

int GgApp::main(int argc, const char* const* argv)
{
  Window window{ "ggsample11", 800, 800 };
  GgSimpleShader shader{ "ggsample11.vert", "ggsample11.frag" };
  const auto mv{ ggLookat(0.0f, 3.0f, 8.0f, 0.0f, 1.0f, 0.0f, 0.0f, 1.0f, 0.0f) };
  light.position = mv * lp;

  // The plane n.x * x + n.y * y + n.z * z + d = 0.
  constexpr GLfloat n[]{ 0.0f, 1.0f, 0.0f };
  constexpr GLfloat d{ 0.0f };
  const GLfloat k{ n[0] * lp[0] + n[1] * lp[1] + n[2] * lp[2] + d };
  const GLfloat m[]
  {
    k - lp[0] * n[0], -lp[1] * n[0], -lp[2] * n[0], -n[0],
    -lp[0] * n[1], k - lp[1] * n[1], -lp[2] * n[1], -n[1],
    -lp[0] * n[2], -lp[1] * n[2], k - lp[2] * n[2], -n[2],
    -lp[0] * d, -lp[1] * d, -lp[2] * d, k - d
  };
  const GgMatrix ms{ m };

  while (window)
  {
    drawFloor(shader, mv);
    glDisable(GL_DEPTH_TEST);
    for (int i = 0; i < figures; ++i)
    {
      const auto ma{ place(t, i) };
      shader.loadModelviewMatrix(mv * ms * ma);
      figure->draw();
    }
    glEnable(GL_DEPTH_TEST);
    drawFigures(shader, mv);
    window.swapBuffers();
  }
  return 0;
}
