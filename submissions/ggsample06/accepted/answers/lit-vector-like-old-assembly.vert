#version 410 core
const vec4 pl=vec4(0.,0.,1.,0.),lamb=vec4(.2,.2,.2,1.),ldiff=vec4(1.,1.,1.,0.),lspec=vec4(1.,1.,1.,0.);
const vec4 kamb=vec4(.6,0.,0.,1.),kdiff=vec4(.6,0.,0.,1.),kspec=vec4(.4,.4,.4,1.);
const float kshi=80.;
in vec4 pv,cv;
uniform mat4 mw,mc,mg;
out vec4 vc;
// lit(): x=1, y=max(n.l,0), z=max(n.h,0)^m
vec3 lit_(float nl,float nh,float m){return vec3(1.,max(nl,0.),pow(max(nh,0.),m));}
void main(){
vec4 p=mw*pv;
vec3 v=-normalize(p.xyz/p.w);
vec3 l=normalize((pl*p.w-p*pl.w).xyz);
vec3 n=normalize((mg*cv).xyz);
vec3 c=lit_(dot(n,l),dot(n,normalize(l+v)),kshi);
vc=c.x*kamb*lamb+c.y*kdiff*ldiff+c.z*kspec*lspec;
gl_Position=mc*pv;
}
