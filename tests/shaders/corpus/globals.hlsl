float3 gSpecular;
float gPower;
static const float kInv8Pi = 0.0397887358;

float3 Specular(float3 normal, float3 toEye, float3 toLight)
{
    float3 h = normalize(toEye + toLight);
    float ndl = max(dot(normal, toLight), 0);
    return gSpecular * (gPower + 2) * kInv8Pi * pow(max(dot(normal, h), 0), gPower) * ndl;
}
