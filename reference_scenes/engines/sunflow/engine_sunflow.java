// engine_sunflow: renders by Sunflow's library. Takes scenes as scene_program.cpp does, in the form of native_engine.hpp.
// Started from its source, so that nothing has to be compiled where there is no JDK.

import java.io.BufferedReader;
import java.io.IOException;
import java.io.InputStreamReader;
import java.nio.ByteBuffer;
import java.nio.ByteOrder;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Timer;
import java.util.TimerTask;
import org.sunflow.SunflowAPI;
import org.sunflow.core.Display;
import org.sunflow.image.Color;
import org.sunflow.math.Matrix4;
import org.sunflow.math.Point3;
import org.sunflow.math.Vector3;
import org.sunflow.system.UI;
import org.sunflow.system.ui.SilentInterface;

class EngineSunflow {
  static final int TIMED_OUT = 142; // as if ended by SIGALRM

  /** Keeps the pixels as they are computed, RGB, the lowest row first. */
  static class Pixels implements Display {
    int width, height;
    ByteBuffer values;

    public void imageBegin(int w, int h, int bucketSize) {
      width = w;
      height = h;
      values = ByteBuffer.allocate(12 * w * h).order(ByteOrder.LITTLE_ENDIAN);
    }

    public void imagePrepare(int x, int y, int w, int h, int id) {}

    public void imageUpdate(int x, int y, int w, int h, Color[] data, float[] alpha) {
      for (int j = 0; j < h; ++j)
        for (int i = 0; i < w; ++i) put(x + i, y + j, data[j * w + i]);
    }

    public void imageFill(int x, int y, int w, int h, Color c, float alpha) {
      for (int j = 0; j < h; ++j) for (int i = 0; i < w; ++i) put(x + i, y + j, c);
    }

    public void imageEnd() {}

    void put(int x, int y, Color color) {
      float[] rgb = color.getRGB();
      for (int c = 0; c < 3; ++c) values.putFloat(4 * (3 * ((height - 1 - y) * width + x) + c), rgb[c]);
    }
  }

  /** One scene on its way into Sunflow. */
  static class Reader {
    final SunflowAPI api = new SunflowAPI();
    final List<String> shaders = new ArrayList<>();
    String name = "?";
    double seconds;
    int width, height, count;

    Reader() {
      api.parameter("sampler", "bucket");
      api.parameter("gi.engine", "none");
      api.parameter("aa.min", 0); // one ray for each pixel
      api.parameter("aa.max", 0);
      api.parameter("aa.samples", 1);
      api.parameter("filter", "box");
      api.parameter("threads", 1);
      api.parameter("threads.lowPriority", false);
      api.options(SunflowAPI.DEFAULT_OPTIONS);
    }

    /** Sunflow looks along -z. */
    static float z(String[] words, int at) {
      return -Float.parseFloat(words[at]);
    }

    static float f(String[] words, int at) {
      return Float.parseFloat(words[at]);
    }

    static Point3 point(String[] words, int at) {
      return new Point3(f(words, at), f(words, at + 1), z(words, at + 2));
    }

    /** Any other name of the space is ignored in silence. */
    void colour(String parameter, String[] words, int at, double factor) {
      float[] rgb = new float[3];
      for (int c = 0; c < 3; ++c) rgb[c] = (float) (factor * Double.parseDouble(words[at + c]));
      api.parameter(parameter, "sRGB linear", rgb[0], rgb[1], rgb[2]);
    }

    void window(String[] words) {
      double left = Double.parseDouble(words[1]), right = Double.parseDouble(words[2]);
      double bottom = Double.parseDouble(words[3]), top = Double.parseDouble(words[4]);
      // Sunflow's rays go through i + 0.5 of W - 1 pixels: half a pixel too far to the right and up.
      double halfWidth = (right - left) / 2 * (width - 1) / width;
      double halfHeight = (top - bottom) / 2 * (height - 1) / height;
      api.parameter("transform", Matrix4.IDENTITY);
      api.parameter("fov", (float) Math.toDegrees(2 * Math.atan(halfWidth)));
      api.parameter("aspect", (float) (halfWidth / halfHeight));
      api.parameter("shift.x", (float) ((left + right) / 2 - (right - left) / 2 / width));
      api.parameter("shift.y", (float) ((bottom + top) / 2 - (top - bottom) / 2 / height));
      api.camera("camera", "pinhole");
      api.parameter("resolutionX", width);
      api.parameter("resolutionY", height);
      api.parameter("camera", "camera");
      api.options(SunflowAPI.DEFAULT_OPTIONS);
    }

    void light(String[] words) {
      if (words[1].equals("directional")) {
        float far = 1000; // a disc of parallel light, wider than everything
        Vector3 to = new Vector3(f(words, 2), f(words, 3), z(words, 4));
        api.parameter("source", new Point3(far * to.x, far * to.y, far * to.z));
        api.parameter("dir", new Vector3(-to.x, -to.y, -to.z));
        api.parameter("radius", 10 * far);
        colour("radiance", words, 5, 1);
      } else {
        api.parameter("center", point(words, 2));
        colour("power", words, 5, 4 * Math.PI);
      }
      api.light("light" + count++, words[1].equals("directional") ? "directional" : "point");
    }

    void material(String[] words) {
      String shader = "material" + shaders.size();
      colour("diffuse", words, 4, Math.PI);
      if (words[1].equals("none")) {
        api.shader(shader, "diffuse");
      } else {
        float strength = f(words, 3);
        api.parameter("specular", "sRGB linear", strength, strength, strength);
        api.parameter("power", f(words, 2));
        api.parameter("samples", 0);
        api.shader(shader, "phong");
      }
      shaders.add(shader);
    }

    void instance(String kind, Matrix4 transform, String material) {
      String geometry = kind + count++;
      api.geometry(geometry, kind);
      api.parameter("shaders", new String[] {shaders.get(Integer.parseInt(material))});
      api.parameter("transform", transform);
      api.instance(geometry + ".instance", geometry);
    }

    void take(String[] words) {
      switch (words[0]) {
        case "scene" -> name = words[1];
        case "seconds" -> seconds = Double.parseDouble(words[1]);
        case "film" -> {
          width = Integer.parseInt(words[1]);
          height = Integer.parseInt(words[2]);
        }
        case "window" -> window(words);
        case "light" -> light(words);
        case "material" -> material(words);
        case "sphere" -> {
          Point3 centre = point(words, 1);
          instance("sphere",
              Matrix4.translation(centre.x, centre.y, centre.z).multiply(Matrix4.scale(f(words, 4))),
              words[5]);
        }
        case "plane" -> {
          api.parameter("center", point(words, 1));
          api.parameter("normal", new Vector3(f(words, 4), f(words, 5), z(words, 6)));
          instance("plane", Matrix4.IDENTITY, words[7]);
        }
        case "end" -> {}
        default -> throw new IllegalArgumentException("a scene with '" + words[0] + "'");
      }
    }
  }

  static void renderFile(String file, Timer alarm) throws IOException {
    long begun = System.nanoTime();
    Reader reader = new Reader();
    try {
      for (String line : Files.readAllLines(Path.of(file))) reader.take(line.split(" "));
      System.out.println("lobelia: begin " + reader.name);
      TimerTask end = new TimerTask() {
        public void run() {
          Runtime.getRuntime().halt(TIMED_OUT);
        }
      };
      alarm.schedule(end, (long) (1000 * Math.min(reader.seconds, 1e9)));
      Pixels pixels = new Pixels();
      reader.api.render(SunflowAPI.DEFAULT_OPTIONS, pixels);
      end.cancel();
      if (pixels.values == null) throw new IllegalStateException("Sunflow rendered nothing");
      String head = "PF\n" + pixels.width + " " + pixels.height + "\n-1.0\n";
      try (var out = Files.newOutputStream(Path.of(reader.name + "-0.pfm"))) {
        out.write(head.getBytes(StandardCharsets.US_ASCII));
        out.write(pixels.values.array());
      }
      System.out.printf(java.util.Locale.ROOT, "lobelia: done %s %.6f%n", reader.name,
          1e-9 * (System.nanoTime() - begun));
    } catch (RuntimeException error) {
      System.out.println("lobelia: failed " + reader.name + " " + error);
    }
  }

  public static void main(String[] arguments) throws IOException {
    if (arguments.length != 1) {
      System.err.println("engine_sunflow --version or FILE");
      System.exit(2);
    }
    if (arguments[0].equals("--version")) {
      System.out.println("Sunflow " + SunflowAPI.VERSION);
      return;
    }
    UI.set(new SilentInterface()); // its progress would be in our lines
    Timer alarm = new Timer(true);
    BufferedReader more = new BufferedReader(new InputStreamReader(System.in));
    for (String file = arguments[0]; file != null && !file.isEmpty(); file = more.readLine()) {
      renderFile(file, alarm);
      System.out.println("lobelia: more");
    }
  }
}
