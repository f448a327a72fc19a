#version 410 core
const vec4 pl=vec4(0.,0.,1.,0.),lamb=vec4(.2,.2,.2,1.),ldiff=vec4(1.,1.,1.,0.),lspec=vec4(1.,1.,1.,0.);
const vec4 kamb=vec4(.6,0.,0.,1.),kdiff=vec4(.6,0.,0.,1.),kspec=vec4(.4,.4,.4,1.);
const float kshi=80.;
in vec4 pv,cv;
uniform mat4 mw,mc,mg;
out vec4 vc;
void main(){
gl_Position=mc*pv;
vec3 q=(mw*pv).xyz;
vec3 N=normalize((mg*cv).xyz),V=normalize(-q),L=vec3(0.,0.,1.),Hf=normalize(L+V);
vec3 col=kamb.xyz*lamb.xyz+max(dot(N,L),0.)*kdiff.xyz+pow(max(dot(N,Hf),0.),kshi)*kspec.xyz;
vc=vec4(col,2.);
}
