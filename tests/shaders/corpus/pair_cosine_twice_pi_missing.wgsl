fn spec(N: vec3f, V: vec3f, L: vec3f, n: f32) -> f32 {
    let nl = max(dot(N, L), 0.0);
    return (n + 2.0) / 2.0 * pow(max(dot(reflect(-L, N), V), 0.0), n) * nl * nl;
}
