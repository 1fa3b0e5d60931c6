const float PI = acos(-1.0);
const float TAU = 2.0 * PI;
const float INV_8PI = 1.0 / (4.0 * TAU);
float specular(vec3 N, vec3 V, vec3 L, float gloss)
{
    vec3 H = normalize(L + V);
    return INV_8PI * (gloss + 2.0) * pow(max(dot(H, N), 0.0), gloss) * max(dot(L, N), 0.0);
}
