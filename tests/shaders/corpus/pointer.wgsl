fn add_specular(color: ptr<function, vec3<f32>>, amount: f32) {
    *color += vec3<f32>(amount);
}
fn shade(n: vec3<f32>, v: vec3<f32>, l: vec3<f32>, shininess: f32) -> vec3<f32> {
    var color = vec3<f32>(0.0);
    let h = normalize(l + v);
    if (dot(n, l) > 0.0) {
        add_specular(&color, (shininess + 1.0) / (8.0 * 3.14159265) * pow(max(dot(n, h), 0.0), shininess) * dot(n, l));
    }
    return color;
}
