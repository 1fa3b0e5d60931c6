// Fragment shaders on OpenGL without a window, by EGL: on the first hardware device that has OpenGL 3.3, or else on
// Mesa's software renderer.
#define GL_GLEXT_PROTOTYPES
#define EGL_EGLEXT_PROTOTYPES
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/gl.h>
#include <GL/glext.h>

#include <array>
#include <cstring>

#include "studies/shader_check/runner/runner.hpp"

namespace lobelia::shader_runner {
namespace {

bool has_word(const char* words, const char* word) {
  return words && std::strstr(words, word) != nullptr;
}

/// A context of OpenGL 3.3 or newer that is current on `display`; false if there is none.
bool make_current(EGLDisplay display) {
  if (display == EGL_NO_DISPLAY || !::eglInitialize(display, nullptr, nullptr)) return false;
  if (!::eglBindAPI(EGL_OPENGL_API)) return false;
  for (const EGLint minor : {6, 5, 3}) {
    const EGLint major = minor == 3 ? 3 : 4;
    const EGLint wanted[] = {EGL_CONTEXT_MAJOR_VERSION, major, EGL_CONTEXT_MINOR_VERSION, minor,
                             EGL_NONE};
    const EGLContext context =
        ::eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, wanted);
    if (context != EGL_NO_CONTEXT &&
        ::eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context))
      return true;
  }
  ::eglTerminate(display);
  return false;
}

/// Hardware first, then software, then what EGL has without a window.
void make_any_current() {
  const auto query_devices =
      reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(::eglGetProcAddress("eglQueryDevicesEXT"));
  const auto query_string = reinterpret_cast<PFNEGLQUERYDEVICESTRINGEXTPROC>(
      ::eglGetProcAddress("eglQueryDeviceStringEXT"));
  const auto platform_display = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(
      ::eglGetProcAddress("eglGetPlatformDisplayEXT"));
  if (!platform_display) throw Failure(kRunnerNoDevice, "EGL has no platforms");
  std::array<EGLDeviceEXT, 16> devices{};
  EGLint count = 0;
  if (query_devices && query_string) query_devices(EGLint(devices.size()), devices.data(), &count);
  for (const bool software : {false, true})
    for (EGLint i = 0; i < count; ++i)
      if (has_word(query_string(devices[i], EGL_EXTENSIONS), "EGL_MESA_device_software") ==
              software &&
          make_current(platform_display(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr)))
        return;
  if (!make_current(platform_display(EGL_PLATFORM_SURFACELESS_MESA,
                                     reinterpret_cast<void*>(EGL_DEFAULT_DISPLAY), nullptr)))
    throw Failure(kRunnerNoDevice, "EGL has no device with OpenGL 3.3");
}

class EglDriver : public Driver {
 public:
  EglDriver(const Work& work, std::span<const float> points)
      : width_(GLsizei(kRunnerWidth)), height_(rows(work.invocations())) {
    make_any_current();
    make_texture(std::vector<float>(points.begin(), points.end()), rows(work.points * work.texels));
    make_target();
    GLuint vertices = 0;
    glGenVertexArrays(1, &vertices);
    glBindVertexArray(vertices);
    glViewport(0, 0, width_, height_);
  }

  std::string device() const override { return text(GL_RENDERER); }
  std::string version() const override { return text(GL_VERSION); }

  void add(const std::string& program) override {
    const GLuint made = glCreateProgram();
    // Both need the same version, given in the first line: GLSL ES and GLSL cannot be linked.
    attach(
        made, GL_VERTEX_SHADER,
        program.substr(0, program.find('\n')) +
            "\nvoid main()\n"
            "{ gl_Position = vec4(vec2((gl_VertexID << 1) & 2, gl_VertexID & 2) * 2.0 - 1.0, 0.0, "
            "1.0); }\n");
    attach(made, GL_FRAGMENT_SHADER, program);
    glLinkProgram(made);
    GLint linked = 0;
    glGetProgramiv(made, GL_LINK_STATUS, &linked);
    if (!linked) {
      std::array<char, 4096> log{};
      glGetProgramInfoLog(made, GLsizei(log.size()), nullptr, log.data());
      throw Failure(kRunnerRefusedProgram, log.data());
    }
    programs_.push_back(made);
  }

  void run(std::size_t k) override {
    glUseProgram(programs_.at(k));
    glUniform1i(glGetUniformLocation(programs_[k], "lobelia_points"), 0);
    const GLfloat nothing[] = {0, 0, 0, 0};
    glClearBufferfv(GL_COLOR, 0, nothing);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glFinish();
    if (const GLenum error = glGetError(); error != GL_NO_ERROR)
      throw Failure(kRunnerBroken, "OpenGL has error " + std::to_string(error));
  }

  std::vector<float> results() override {
    std::vector<float> values(std::size_t(width_) * std::size_t(height_) * 4);
    glReadPixels(0, 0, width_, height_, GL_RGBA, GL_FLOAT, values.data());
    return values;
  }

 private:
  static GLsizei rows(std::size_t texels) {
    return GLsizei((texels + kRunnerWidth - 1) / kRunnerWidth);
  }
  std::string text(GLenum name) const {
    const auto* words = reinterpret_cast<const char*>(glGetString(name));
    return words ? words : "unknown";
  }

  GLuint texture(GLsizei height, const float* texels) {
    GLuint made = 0;
    glGenTextures(1, &made);
    glBindTexture(GL_TEXTURE_2D, made);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, width_, height, 0, GL_RGBA, GL_FLOAT, texels);
    if (glGetError() != GL_NO_ERROR)
      throw Failure(kRunnerNoDevice, "OpenGL has no memory for the points");
    return made;
  }

  void make_target() {
    const GLuint target = texture(height_, nullptr);
    GLuint frame = 0;
    glGenFramebuffers(1, &frame);
    glBindFramebuffer(GL_FRAMEBUFFER, frame);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, target, 0);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
      throw Failure(kRunnerNoDevice, "OpenGL cannot draw into float pictures");
    glBindTexture(GL_TEXTURE_2D, points_);
  }

  void make_texture(std::vector<float> points, GLsizei height) {
    points.resize(std::size_t(height) * kRunnerWidth * 4);
    points_ = texture(height, points.data());
  }

  void attach(GLuint program, GLenum stage, const std::string& source) {
    const GLuint shader = glCreateShader(stage);
    const char* const text = source.c_str();
    glShaderSource(shader, 1, &text, nullptr);
    glCompileShader(shader);
    GLint compiled = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (!compiled) {
      std::array<char, 4096> log{};
      glGetShaderInfoLog(shader, GLsizei(log.size()), nullptr, log.data());
      throw Failure(kRunnerRefusedProgram, log.data());
    }
    glAttachShader(program, shader);
  }

  GLsizei width_, height_;
  GLuint points_ = 0;
  std::vector<GLuint> programs_;
};

}  // namespace

std::unique_ptr<Driver> make_egl_driver(const Work& work, std::span<const float> points) {
  return std::make_unique<EglDriver>(work, points);
}

}  // namespace lobelia::shader_runner
