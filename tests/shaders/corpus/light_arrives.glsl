float spec(vec3 n, vec3 incident, vec3 lightTravels, float p)
{
    vec3 r = reflect(lightTravels, n);
    return (p + 2.0) / 6.28318530718 * pow(max(dot(r, -incident), 0.0), p) * max(-dot(n, lightTravels), 0.0);
}
