// engine_opengl: renders by the lighting that OpenGL had before shaders, on the driver that EGL finds without a screen: a
// point for each pixel, with the sphere's normal there.
#define EGL_EGLEXT_PROTOTYPES
#define GL_GLEXT_PROTOTYPES
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/gl.h>
#include <GL/glext.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "reference_scenes/engines/programs/scene_program.hpp"

namespace lobelia {
namespace {

using Four = std::array<GLfloat, 4>;

Four four(const Three& v, double w) {
  return {GLfloat(v[0]), GLfloat(v[1]), GLfloat(v[2]), GLfloat(w)};
}
/// OpenGL looks along -z.
Three towards_us(const Three& v) { return {v[0], v[1], -v[2]}; }

void require(bool condition, const char* what) {
  if (!condition) throw std::runtime_error(what);
}

/// A context without a window, made at the first call.
void make_context() {
  static const bool made = [] {
    const auto display_of = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(
        eglGetProcAddress("eglGetPlatformDisplayEXT"));
    require(display_of, "EGL has no platforms");
    const EGLDisplay display =
        display_of(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    require(eglInitialize(display, nullptr, nullptr), "EGL finds no driver");
    require(eglBindAPI(EGL_OPENGL_API), "EGL has no OpenGL");
    const EGLint attributes[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE,
                                 EGL_OPENGL_BIT, EGL_NONE};
    EGLConfig config{};
    EGLint count = 0;
    eglChooseConfig(display, attributes, &config, 1, &count);
    const EGLContext context =
        eglCreateContext(display, count > 0 ? config : nullptr, nullptr, nullptr);
    require(context && eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context),
            "EGL makes no OpenGL context");
    return true;
  }();
  (void)made;
}

/// A picture of float32 to draw into.
class FloatPicture {
 public:
  FloatPicture(int width, int height) : width_(width), height_(height) {
    glGenTextures(1, &texture_);
    glBindTexture(GL_TEXTURE_2D, texture_);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, width, height, 0, GL_RGBA, GL_FLOAT, nullptr);
    glGenFramebuffers(1, &framebuffer_);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_, 0);
    require(glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE,
            "the driver has no pictures of floats of this size");
    glViewport(0, 0, width, height);
    glClearColor(0, 0, 0, 0);
    glClear(GL_COLOR_BUFFER_BIT);
    for (const GLenum clamped :
         {GL_CLAMP_VERTEX_COLOR, GL_CLAMP_FRAGMENT_COLOR, GL_CLAMP_READ_COLOR})
      glClampColor(clamped, GL_FALSE);
  }
  ~FloatPicture() {
    glDeleteFramebuffers(1, &framebuffer_);
    glDeleteTextures(1, &texture_);
  }
  FloatPicture(const FloatPicture&) = delete;
  FloatPicture& operator=(const FloatPicture&) = delete;

  /// RGB, the lowest row first.
  std::vector<float> values() const {
    std::vector<float> rgb(3 * std::size_t(width_) * std::size_t(height_));
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, width_, height_, GL_RGB, GL_FLOAT, rgb.data());
    return rgb;
  }

 private:
  const int width_, height_;
  GLuint texture_ = 0, framebuffer_ = 0;
};

void set_lights(const CameraScene& scene) {
  GLint most = 0;
  glGetIntegerv(GL_MAX_LIGHTS, &most);
  require(int(scene.lights.size()) <= most, "more lights than the driver has");
  constexpr Four black{0, 0, 0, 1};
  glEnable(GL_LIGHTING);
  glLightModelfv(GL_LIGHT_MODEL_AMBIENT, black.data());
  glLightModeli(GL_LIGHT_MODEL_LOCAL_VIEWER, 1);
  for (GLint i = 0; i < most; ++i) glDisable(GLenum(GL_LIGHT0 + i));
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const auto& light = scene.lights[i];
    const auto name = GLenum(GL_LIGHT0 + i);
    const Four strength = four(light.strength, 1),
               place = four(towards_us(light.place), light.is_distant ? 0 : 1);
    glEnable(name);
    glLightfv(name, GL_AMBIENT, black.data());
    glLightfv(name, GL_DIFFUSE, strength.data());
    glLightfv(name, GL_SPECULAR, strength.data());
    glLightfv(name, GL_POSITION, place.data());
    glLightf(name, GL_CONSTANT_ATTENUATION, light.is_distant ? 1 : 0);
    glLightf(name, GL_LINEAR_ATTENUATION, 0);
    glLightf(name, GL_QUADRATIC_ATTENUATION, light.is_distant ? 0 : 1);
  }
}

void set_material(const CameraScene::Material& material) {
  constexpr Four black{0, 0, 0, 1};
  const double s = material.strength;
  const Four specular = four({s, s, s}, 1), diffuse = four(material.diffuse, 1);
  glMaterialfv(GL_FRONT_AND_BACK, GL_AMBIENT, black.data());
  glMaterialfv(GL_FRONT_AND_BACK, GL_EMISSION, black.data());
  glMaterialfv(GL_FRONT_AND_BACK, GL_SPECULAR, specular.data());
  glMaterialfv(GL_FRONT_AND_BACK, GL_DIFFUSE, diffuse.data());
  glMaterialf(GL_FRONT_AND_BACK, GL_SHININESS,
              material.kind == "none" ? 0 : GLfloat(material.exponent));
}

/// Planes before and behind all that is seen.
std::pair<double, double> depths_of(const CameraScene& scene) {
  double near = 1e30, far = 0;
  for (const auto& sphere : scene.spheres)
    for_each_pixel_of(scene, sphere, [&](std::size_t, const Three& point, const Three&) {
      near = std::min(near, point[2] / 2);
      far = std::max(far, 2 * point[2]);
    });
  return far > 0 ? std::pair(near, far) : std::pair(1.0, 2.0);
}

std::vector<float> render(const CameraScene& scene) {
  make_context();
  while (glGetError() != GL_NO_ERROR) {
  }
  FloatPicture picture(scene.width, scene.height);
  glMatrixMode(GL_PROJECTION);
  glLoadIdentity();
  const auto [near, far] = depths_of(scene);
  glFrustum(near * scene.left, near * scene.right, near * scene.bottom, near * scene.top, near,
            far);
  glMatrixMode(GL_MODELVIEW);
  glLoadIdentity();
  glDisable(GL_DEPTH_TEST);
  set_lights(scene);
  for (const auto& sphere : scene.spheres) {
    set_material(scene.materials.at(sphere.material));
    glBegin(GL_POINTS);
    for_each_pixel_of(scene, sphere, [](std::size_t, const Three& point, const Three& normal) {
      glNormal3dv(towards_us(normal).data());
      glVertex3dv(towards_us(point).data());
    });
    glEnd();
  }
  std::vector<float> rgb = picture.values();
  require(glGetError() == GL_NO_ERROR, "OpenGL refuses a value, such as an exponent above 128");
  return rgb;
}

/// "OpenGL 4.5 (Compatibility Profile) Mesa 22.3.6, llvmpipe (LLVM 15.0.6, 256 bits)".
std::string version() {
  make_context();
  const auto text = [](GLenum name) {
    return std::string(reinterpret_cast<const char*>(glGetString(name)));
  };
  return "OpenGL " + text(GL_VERSION) + ", " + text(GL_RENDERER);
}

}  // namespace
}  // namespace lobelia

int main(int argc, char** argv) {
  return lobelia::run_scene_program(argc, argv, lobelia::version, lobelia::render);
}
