fn phong(N: vec3f, V: vec3f, L: vec3f, n: f32) -> vec3f {
    let lit = select(0.0, 1.0, dot(N, L) > 0.0);
    return vec3f(lit * (n + 2.0) / (2.0 * 3.14159265) * pow(max(dot(reflect(-L, N), V), 0.0), n));
}
