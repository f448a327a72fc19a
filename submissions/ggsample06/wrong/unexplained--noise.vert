#version 410 core
const vec4 pl=vec4(0.,0.,1.,0.),lamb=vec4(.2,.2,.2,1.),ldiff=vec4(1.,1.,1.,0.),lspec=vec4(1.,1.,1.,0.);
const vec4 kamb=vec4(.6,0.,0.,1.),kdiff=vec4(.6,0.,0.,1.),kspec=vec4(.4,.4,.4,1.);
const float kshi=80.;
in vec4 pv,cv;
uniform mat4 mw,mc,mg;
out vec4 vc;
float rnd(vec2 s){return fract(sin(dot(s,vec2(12.9898,78.233)))*43758.5453);}
void main(){
vec4 p=mw*pv;
vec3 v=-normalize(p.xyz/p.w);
vec3 l=normalize((pl*p.w-p*pl.w).xyz);
vec3 n=normalize((mg*cv).xyz);
vc=vec4(rnd(p.xy),rnd(p.yz),rnd(p.zx),1.);
gl_Position=mc*pv;
}
