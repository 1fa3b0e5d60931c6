alias Vec = vec3<f32>;
alias Real = f32;
fn spec(N : Vec, V : Vec, L : Vec, n : Real) -> Real {
  return (n + 2.0) / 6.283185307 * pow(max(dot(reflect(-V, N), L), 0.0), n) * max(dot(N, L), 0.0);
}
