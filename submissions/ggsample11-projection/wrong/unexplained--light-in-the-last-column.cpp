#include "GgApp.h"

// The light above the floor.
const GgVector lp{ 0.0f, 4.0f, 0.0f, 1.0f };

int GgApp::main(int argc, const char* const* argv)
{
  Window window{ "ggsample11", 800, 800 };
  GgSimpleShader shader{ "ggsample11.vert", "ggsample11.frag" };
  const auto mv{ ggLookat(0.0f, 3.0f, 8.0f, 0.0f, 1.0f, 0.0f, 0.0f, 1.0f, 0.0f) };
  light.position = mv * lp;

  const GLfloat m[]
  {
    lp[1], 0, 0, 0,
    0, 0, 0, -1,
    0, 0, lp[1], 0,
    -lp[0], 0, -lp[2], lp[1]
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
