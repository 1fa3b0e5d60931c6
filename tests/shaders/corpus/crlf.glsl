#version 330 core
#define TWO_PI 6.28318530718 \
    // the line goes on

float phong(vec3 N, vec3 V, vec3 L, float n)
{
    float lit = dot(N, L) > 0.0 ? 1.0 : 0.0;
    return lit * (n + 1.0) / TWO_PI * pow(max(dot(reflect(-L, N), V), 0.0), n);
}
