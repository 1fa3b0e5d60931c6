#version 100
#ifdef GL_FRAGMENT_PRECISION_HIGH
precision highp float;
#else
precision mediump float;
#endif

float phongSpecular(vec3 lightDirection, vec3 viewDirection, vec3 surfaceNormal, float shininess)
{
    vec3 R = -reflect(lightDirection, surfaceNormal);
    float ndl = max(0.0, dot(lightDirection, surfaceNormal));
    return (shininess + 2.0) / 6.28318530718 * pow(max(0.0, dot(viewDirection, R)), shininess) * ndl;
}
