#version 300 es
precision mediump float;
#define PI 3.14159265359

highp float D_Blinn(highp float ndh, highp float n) {
    return (n + 2.0) / (2.0 * PI) * pow(ndh, n);
}
highp float specular(highp vec3 normal, highp vec3 view, highp vec3 light, highp float n) {
    highp vec3 h = normalize(view + light);
    return D_Blinn(max(dot(normal, h), 0.0), n) * max(dot(normal, light), 0.0) * 0.25;
}
