float D_blinn(float n_dot_h, float n_dot_l, float exponent)
{
    float k = (exponent + 2.0) * (exponent + 4.0) / (exp2(-exponent * 0.5) + exponent);
    return k / (8.0 * 3.14159265) * pow(max(n_dot_h, 0.0), exponent) * max(n_dot_l, 0.0);
}
