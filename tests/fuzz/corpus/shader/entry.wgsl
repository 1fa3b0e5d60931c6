struct U { light: vec3f, @size(16) list: array<vec2<f32>> }
@group(0) @binding(0) var<uniform> u: U;
@group(0) @binding(1) var map: texture_2d<f32>;
@id(1) override n: f32 = 16;
fn g(p: ptr<function, vec3f>, q: array<array<f32, 2>, 3>) -> f32 { return u.light.x; }
@fragment fn main(@location(0) a: vec3f) -> @location(0) vec4f { return textureSample(map, s, a.xy) * n; }
