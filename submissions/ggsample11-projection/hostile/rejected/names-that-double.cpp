#include "GgApp.h"

// The light above the floor.
const GgVector lp{ 0.0f, 4.0f, 0.0f, 1.0f };

int GgApp::main(int argc, const char* const* argv)
{
  Window window{ "ggsample11", 800, 800 };
  GgSimpleShader shader{ "ggsample11.vert", "ggsample11.frag" };
  const auto mv{ ggLookat(0.0f, 3.0f, 8.0f, 0.0f, 1.0f, 0.0f, 0.0f, 1.0f, 0.0f) };
  light.position = mv * lp;

  const GLfloat a0 = lp[1];
  const GLfloat a1 = a0 + a0;
  const GLfloat a2 = a1 + a1;
  const GLfloat a3 = a2 + a2;
  const GLfloat a4 = a3 + a3;
  const GLfloat a5 = a4 + a4;
  const GLfloat a6 = a5 + a5;
  const GLfloat a7 = a6 + a6;
  const GLfloat a8 = a7 + a7;
  const GLfloat a9 = a8 + a8;
  const GLfloat a10 = a9 + a9;
  const GLfloat a11 = a10 + a10;
  const GLfloat a12 = a11 + a11;
  const GLfloat a13 = a12 + a12;
  const GLfloat a14 = a13 + a13;
  const GLfloat a15 = a14 + a14;
  const GLfloat a16 = a15 + a15;
  const GLfloat a17 = a16 + a16;
  const GLfloat a18 = a17 + a17;
  const GLfloat a19 = a18 + a18;
  const GLfloat a20 = a19 + a19;
  const GLfloat a21 = a20 + a20;
  const GLfloat a22 = a21 + a21;
  const GLfloat a23 = a22 + a22;
  const GLfloat a24 = a23 + a23;
  const GLfloat a25 = a24 + a24;
  const GLfloat a26 = a25 + a25;
  const GLfloat a27 = a26 + a26;
  const GLfloat a28 = a27 + a27;
  const GLfloat a29 = a28 + a28;
  const GLfloat a30 = a29 + a29;
  const GLfloat a31 = a30 + a30;
  const GLfloat a32 = a31 + a31;
  const GLfloat a33 = a32 + a32;
  const GLfloat a34 = a33 + a33;
  const GLfloat a35 = a34 + a34;
  const GLfloat a36 = a35 + a35;
  const GLfloat a37 = a36 + a36;
  const GLfloat a38 = a37 + a37;
  const GLfloat a39 = a38 + a38;
  const GLfloat a40 = a39 + a39;
  const GLfloat a41 = a40 + a40;
  const GLfloat a42 = a41 + a41;
  const GLfloat a43 = a42 + a42;
  const GLfloat a44 = a43 + a43;
  const GLfloat a45 = a44 + a44;
  const GLfloat a46 = a45 + a45;
  const GLfloat a47 = a46 + a46;
  const GLfloat a48 = a47 + a47;
  const GLfloat a49 = a48 + a48;
  const GLfloat a50 = a49 + a49;
  const GLfloat a51 = a50 + a50;
  const GLfloat a52 = a51 + a51;
  const GLfloat a53 = a52 + a52;
  const GLfloat a54 = a53 + a53;
  const GLfloat a55 = a54 + a54;
  const GLfloat a56 = a55 + a55;
  const GLfloat a57 = a56 + a56;
  const GLfloat a58 = a57 + a57;
  const GLfloat a59 = a58 + a58;
  const GLfloat a60 = a59 + a59;
  const GLfloat a61 = a60 + a60;
  const GLfloat a62 = a61 + a61;
  const GLfloat a63 = a62 + a62;
  const GLfloat m[]
  {
    a63, 0.0f, 0.0f, 0.0f,
    -lp[0], 0.0f, -lp[2], -1.0f,
    0.0f, 0.0f, lp[1], 0.0f,
    0.0f, 0.0f, 0.0f, lp[1]
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
