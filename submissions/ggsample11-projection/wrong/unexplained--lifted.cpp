// Figures that hop over a floor. Each has a round shadow below it: an ellipse that is laid flat on the floor.
//
// To do: the shadow of the figure itself. Only what is marked with "to do" has to change.

#include "GgApp.h"

#include <cmath>

// How many figures there are, and how long a cycle of their motion is, in seconds.
constexpr int figures{ 6 };
constexpr double cycle{ 10.0 };

// The place of the light in the world.
const GgVector lp{ 0.0f, 4.0f, 0.0f, 1.0f };

// The light as the shader is given it; its place is filled in when the camera is known.
GgSimpleShader::Light light
{
  { 0.2f, 0.2f, 0.2f, 1.0f },
  { 1.0f, 1.0f, 1.0f, 0.0f },
  { 1.0f, 1.0f, 1.0f, 0.0f },
  { 0.0f, 0.0f, 0.0f, 1.0f }
};

// Shadows have ambient light alone.
const GgSimpleShader::Material dark
{
  { 0.2f, 0.2f, 0.2f, 1.0f },
  { 0.0f, 0.0f, 0.0f, 0.0f },
  { 0.0f, 0.0f, 0.0f, 0.0f },
  1.0f
};

// Where figure number i is at time t of the cycle.
static GgMatrix place(float t, int i)
{
  const float turn{ 3.1415927f * (2.0f * i / figures - 4.0f * t) };
  const float hop{ std::fmod(36.0f * t, 2.0f) - 1.0f };
  return ggRotateY(turn).translate(0.0f, 1.0f - hop * hop, 1.5f);
}

int GgApp::main(int argc, const char* const* argv)
{
  Window window{ "ggsample11", 800, 800 };
  GgSimpleShader shader{ "ggsample11.vert", "ggsample11.frag" };

  const GgSimpleObj floor{ "floor.obj" };
  const auto figure{ ggElementsObj("figure.obj") };
  const auto ellipse{ ggEllipse(0.8f, 0.6f, 24) };
  const GgSimpleShader::MaterialBuffer shadowMaterial{ dark };
  const GgSimpleShader::MaterialBuffer figureMaterial{ colours(figures) };

  // From the world to the eye.
  const auto mv{ ggLookat(0.0f, 3.0f, 8.0f, 0.0f, 1.0f, 0.0f, 0.0f, 1.0f, 0.0f) };
  light.position = mv * lp;
  const GgSimpleShader::LightBuffer lightBuffer{ light };

  // What becomes of a place in the world when its shadow is drawn, one column of the matrix a line. Here it loses its height.
  // To do: the matrix of the projection from the light onto the floor (y = 0).
  // 床に埋まらないように少し浮かせる
  const GLfloat m[]
  {
    lp[1], 0.0f, 0.0f, 0.0f,
    -lp[0], 0.0f, -lp[2], -1.0f,
    0.0f, 0.0f, lp[1], 0.0f,
    0.0f, 0.001f, 0.0f, lp[1]
  };
  const GgMatrix ms{ m };

  glEnable(GL_DEPTH_TEST);
  glEnable(GL_CULL_FACE);
  glfwSetTime(0.0);

  while (window)
  {
    const auto t{ static_cast<float>(std::fmod(glfwGetTime(), cycle) / cycle) };
    const auto mp{ ggPerspective(0.5f, window.getAspect(), 1.0f, 15.0f) };
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    shader.use(lightBuffer);

    // First the floor.
    shader.loadMatrix(mp, mv);
    floor.draw();

    // Then the shadows, at the height of the floor: none of them may be hidden by it.
    shadowMaterial.select();
    glDisable(GL_DEPTH_TEST);
    for (int i = 0; i < figures; ++i)
    {
      // To do: draw the figure. It needs no quarter turn, which only lays the ellipse down.
      shader.loadModelviewMatrix(mv * ms * place(t, i));
      figure->draw();
    }
    glEnable(GL_DEPTH_TEST);

    // Last the figures.
    for (int i = 0; i < figures; ++i)
    {
      figureMaterial.select(i);
      shader.loadModelviewMatrix(mv * place(t, i));
      figure->draw();
    }

    window.swapBuffers();
  }

  return 0;
}
