#version 410 core
// Structs in structs, members reached through several dots, and assignment of whole members.
struct Terms { vec4 ambient, diffuse, specular; };
struct Inner { vec3 direction; };
struct Scene { Terms light, material; float shininess; Inner sun; };
in vec4 pv, cv;
uniform mat4 mw, mc, mg;
out vec4 vc;
void main()
{
    Scene s;
    s.light = Terms(vec4(.2, .2, .2, 1), vec4(1), vec4(1));
    s.material.ambient = vec4(.6, 0, 0, 1);
    s.material.diffuse = s.material.ambient;
    s.material.specular.rgb = vec3(.4);
    s.material.specular.a = 1.0;
    s.shininess = 80.;
    s.sun.direction = vec3(0, 0, 1);
    Scene copy = s;
    s.sun.direction = vec3(1, 0, 0);                 // the copy keeps its own
    vec3 v = -normalize((mw * pv).xyz), l = copy.sun.direction, n = normalize((mg * cv).xyz);
    float d = max(dot(n, l), 0.), sp = pow(max(dot(n, normalize(l + v)), 0.), copy.shininess);
    vc = copy.material.ambient * copy.light.ambient + d * copy.material.diffuse * copy.light.diffuse
       + sp * copy.material.specular * copy.light.specular;
    gl_Position = mc * pv;
}
