#version 110
varying vec3 N;
varying vec3 L;
varying vec3 E;
uniform float shininess;

void main(void)
{
    vec3 n = normalize(N);
    vec3 l = normalize(L);
    vec3 e = normalize(E);
    float lambertTerm = dot(n, l);
    vec4 final_color = vec4(0.0, 0.0, 0.0, 1.0);
    if (lambertTerm > 0.0)
    {
        vec3 R = reflect(-l, n);
        float specular = pow(max(dot(R, e), 0.0), shininess);
        final_color.rgb += vec3(specular * (shininess + 1.0) / (2.0 * 3.14159265));
    }
    gl_FragColor = final_color;
}
