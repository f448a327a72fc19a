#version 410 core
uniform sampler2DShadow depthMap;
in vec4 iamb;
in vec4 idiff;
in vec4 ispec;
in vec4 st;
layout (location = 0) out vec4 fc;
void main()
{
    vec3 t = st.xyz / st.w;
    if (texture(depthMap, t) < 0.5)
        fc = iamb;
    else
        fc = iamb + idiff + ispec;
}
