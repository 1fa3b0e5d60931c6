vec4 phongColor(vec3 surfaceNormal, vec3 toCamera, vec3 toLight, float shine)
{
    float brightness = dot(surfaceNormal, toLight);
    float specularFactor = dot(reflect(-toLight, surfaceNormal), toCamera);
    specularFactor = max(specularFactor, 0.0);
    float damped = pow(specularFactor, shine) * (shine + 1.0) / 6.283185307;
    if (brightness <= 0.0) damped = 0.0;
    return vec4(vec3(damped), 1.0);
}
