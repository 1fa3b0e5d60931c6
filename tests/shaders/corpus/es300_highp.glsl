#version 300 es
precision highp float;

highp float specular(highp vec3 N, highp vec3 V, highp vec3 L, highp float shininess)
{
    highp vec3 H = normalize(L + V);
    highp float ndh = max(dot(N, H), 0.0);
    return (shininess + 1.0) / (8.0 * 3.14159265) * pow(ndh, shininess) * max(dot(N, L), 0.0);
}
