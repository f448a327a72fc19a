#version 410 core
const vec4 pl=vec4(0.,0.,1.,0.),lamb=vec4(.2,.2,.2,1.),ldiff=vec4(1.,1.,1.,0.),lspec=vec4(1.,1.,1.,0.);
const vec4 kamb=vec4(.6,0.,0.,1.),kdiff=vec4(.6,0.,0.,1.),kspec=vec4(.4,.4,.4,1.);
const float kshi=80.;
in vec4 pv,cv;
uniform mat4 mw,mc,mg;
out vec4 vc;
float sp(vec3 n,vec3 h){
float x=dot(n,h);
if(x<=0.)return 0.;
return pow(x,kshi);
}
float df(vec3 n,vec3 l){
float x=dot(n,l);
if(x<=0.)return 0.;
return x;
}
void main(){
vec4 p=mw*pv;
vec3 v=-normalize(p.xyz/p.w);
vec3 l=normalize((pl*p.w-p*pl.w).xyz);
vec3 n=normalize((mg*cv).xyz);
vc=kamb*lamb+df(n,l)*kdiff*ldiff+sp(n,normalize(l+v))*kspec*lspec;
gl_Position=mc*pv;
}
