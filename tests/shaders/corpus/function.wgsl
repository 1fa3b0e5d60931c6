const PI: f32 = 3.14159265;

fn blinn_phong(N: vec3f, V: vec3f, L: vec3f, n: f32) -> f32 {
    let H = normalize(L + V);
    let ndoth = max(dot(N, H), 0.0);
    return (n + 1.0) / (8.0 * PI) * pow(ndoth, n) * max(dot(N, L), 0.0);
}
