fn specular(N: vec3f, V: vec3f, L: vec3f, n: f32) -> f32 {
    let H = normalize(L + V);
    let D = (n + 2.0) / (2.0 * 3.14159265) * pow(max(dot(N, H), 0.0), n);
    return D * max(dot(N, L), 0.0);
}
