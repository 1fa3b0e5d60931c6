struct Material {
    color: vec3<f32>,
    shininess: f32,
};
@group(0) @binding(0) var<uniform> material: Material;

fn specular(normal: vec3<f32>, view: vec3<f32>, light: vec3<f32>) -> vec3<f32> {
    let r = reflect(-light, normal);
    let s = pow(max(dot(r, view), 0.0), material.shininess);
    let k = (material.shininess + 2.0) / (2.0 * 3.14159265);
    return material.color * k * s * max(dot(normal, light), 0.0);
}
