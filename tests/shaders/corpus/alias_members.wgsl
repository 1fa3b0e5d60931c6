alias Vec = vec3<f32>;
struct Gloss { power : f32, }
struct Material { tint : Vec, gloss : Gloss, }
struct Frame { n : Vec, v : Vec, l : Vec, }
const TAU = 6.283185307179586;
fn mirror(d : Vec, n : Vec) -> Vec { return 2.0 * dot(d, n) * n - d; }
fn eval(f : Frame, m : Material) -> Vec {
  let c = max(dot(mirror(f.v, f.n), f.l), 0.0);
  /* nested /* comment { */ still a comment */
  return m.tint * ((m.gloss.power + 2.0) / TAU * pow(c, m.gloss.power) * max(dot(f.n, f.l), 0.0));
}
