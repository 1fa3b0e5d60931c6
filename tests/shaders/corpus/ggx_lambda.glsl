float lambda(float c, float alpha)
{
    float tan2 = (1.0 - c * c) / (c * c);
    return 0.5 * (sqrt(1.0 + alpha * alpha * tan2) - 1.0);
}
float ggx(vec3 N, vec3 V, vec3 L, float alpha)
{
    float cl = dot(N, L), cv = dot(N, V);
    if (cl <= 0.0 || cv <= 0.0) return 0.0;
    vec3 H = normalize(L + V);
    float ch = dot(N, H);
    float t = ch * ch * (alpha * alpha - 1.0) + 1.0;
    float D = alpha * alpha / (3.14159265 * t * t);
    float G = 1.0 / (1.0 + lambda(cl, alpha) + lambda(cv, alpha));
    return D * G / (4.0 * cl * cv) * cl;
}
