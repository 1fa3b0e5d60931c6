float specularBlinn(float NdotL, float NdotH, float n)
{
    return max(NdotL, 0.0) * pow(max(NdotH, 0.0), n) * (n + 1.0) / 25.1327412287;
}
