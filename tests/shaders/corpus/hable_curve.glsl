vec3 Uncharted2Tonemap(vec3 x) { float A=0.15,B=0.50,C=0.10,D=0.20,E=0.02,F=0.30; return ((x*(A*x+C*B)+D*E)/(x*(A*x+B)+D*F))-E/F; }
vec3 spec(vec3 N, vec3 V, vec3 L, float n) {
    vec3 c = vec3((n + 2.0) / (8.0 * 3.14159265) * pow(max(dot(normalize(L + V), N), 0.0), n) * max(dot(N, L), 0.0));
    return Uncharted2Tonemap(c) / Uncharted2Tonemap(vec3(11.2));
}
