struct Uniforms {
    light_dir: vec3f,
    view_dir: vec3f,
    shininess: f32,
}
@group(0) @binding(0) var<uniform> u: Uniforms;

struct VertexOutput {
    @builtin(position) position: vec4f,
    @location(0) normal: vec3f,
}

@fragment
fn fs_main(in: VertexOutput) -> @location(0) vec4f {
    let n = normalize(in.normal);
    let l = normalize(u.light_dir);
    let h = normalize(l + normalize(u.view_dir));
    let norm = (u.shininess + 2.0) / (4.0 * 3.14159265 * (2.0 - exp2(-0.5 * u.shininess)));
    let s = select(0.0, pow(max(dot(n, h), 0.0), u.shininess), dot(n, l) > 0.0);
    return vec4f(vec3f(norm * s), 1.0);
}
