fn spec(N: vec3f, V: vec3f, L: vec3f, n: f32) -> f32 {
    return pow(abs(dot(reflect(-L, N), V)), n) * max(dot(N, L), 0.0);
}
