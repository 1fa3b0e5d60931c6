float f(vec3 q, vec3 zz, vec3 tmp1, float kk) {
vec3 x_ = normalize(tmp1+zz); float banana = dot(q,x_); float _3 = dot(q,tmp1);
return (kk+1.)*.03978873577*pow(max(banana,0.),kk)*max(_3,0.); }
