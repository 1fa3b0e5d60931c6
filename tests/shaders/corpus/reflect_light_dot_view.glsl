#define PI 3.141592653589793
float phong(vec3 N, vec3 V, vec3 L, float n) {
  vec3 R = reflect(-L, N);
  float NdotL = max(dot(N, L), 0.0);
  return (n + 2.0) / (2.0 * PI) * pow(max(dot(R, V), 0.0), n) * NdotL;
}
