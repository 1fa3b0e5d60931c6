// 鏡面反射の計算(ブリン・フォン){ float x(
/* нормаль }, вектор спостерігача {, вектор джерела (;
   показник степеня "n" // */
float kagami(vec3 N /* 法線 */, vec3 V /* 視線 */, vec3 L /* 光源 */, float n)
{
    vec3 H = normalize(L + V); // ハーフベクトル }
    float s = pow(max(dot(N, H), 0.0), n);
    return (n + 2.0) / (8.0 * 3.14159265) * s * max(dot(N, L), 0.0); // エネルギー保存
}
