#version 410 core
// Everything on one line.
in vec4 pv,cv;uniform mat4 mw,mc,mg;out vec4 vc;void main(){vec3 n=normalize((mg*cv).xyz),v=-normalize((mw*pv).xyz),l=vec3(0,0,1);vc=vec4(.12,0,0,1)+max(dot(n,l),0.)*vec4(.6,0,0,0)+pow(max(dot(n,normalize(l+v)),0.),80.)*vec4(.4,.4,.4,0);gl_Position=mc*pv;}
