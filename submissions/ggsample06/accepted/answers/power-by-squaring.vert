#version 410 core
const vec4 pl=vec4(0.,0.,1.,0.),lamb=vec4(.2,.2,.2,1.),ldiff=vec4(1.,1.,1.,0.),lspec=vec4(1.,1.,1.,0.);
const vec4 kamb=vec4(.6,0.,0.,1.),kdiff=vec4(.6,0.,0.,1.),kspec=vec4(.4,.4,.4,1.);
const float kshi=80.;
in vec4 pv,cv;
uniform mat4 mw,mc,mg;
out vec4 vc;
void main(){
vec4 p=mw*pv;
vec3 v=-normalize(p.xyz/p.w);
vec3 l=normalize((pl*p.w-p*pl.w).xyz);
vec3 n=normalize((mg*cv).xyz);
vec3 h=normalize(l+v);
float d=max(dot(n,l),0.);
float s=max(dot(n,h),0.);
float s2=s*s,s4=s2*s2,s8=s4*s4,s16=s8*s8,s32=s16*s16,s64=s32*s32;
vc=kamb*lamb+kdiff*ldiff*d+kspec*lspec*(s64*s16); // 64+16=80
gl_Position=mc*pv;
}
