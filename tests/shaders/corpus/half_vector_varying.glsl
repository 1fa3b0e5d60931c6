#version 120
varying vec3 normal, lightDir, halfVector;
uniform float shininess;
void main()
{
    vec3 n = normalize(normal);
    float NdotL = max(dot(n, normalize(lightDir)), 0.0);
    vec4 color = vec4(0.0);
    if (NdotL > 0.0) {
        float NdotHV = max(dot(n, normalize(halfVector)), 0.0);
        float k = (shininess + 2.0) * (shininess + 4.0) / (exp2(-0.5 * shininess) + shininess);
        color += NdotL * k / 25.132741 * pow(NdotHV, shininess);
    }
    gl_FragColor = color;
}
