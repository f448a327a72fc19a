#version 410 core
const vec4 pl=vec4(0.,0.,1.,0.),lamb=vec4(.2,.2,.2,1.),ldiff=vec4(1.,1.,1.,0.),lspec=vec4(1.,1.,1.,0.);
const vec4 kamb=vec4(.6,0.,0.,1.),kdiff=vec4(.6,0.,0.,1.),kspec=vec4(.4,.4,.4,1.);
const float kshi=80.;
in vec4 pv,cv;
uniform mat4 mw,mc,mg;
out vec4 vc;
float naiseki(vec3 a,vec3 b){return a.x*b.x+a.y*b.y+a.z*b.z;}
vec3 seikika(vec3 a){return a/sqrt(naiseki(a,a));}
void main(){
vec4 p=mw*pv;
vec3 v=seikika(-p.xyz),l=seikika(pl.xyz),n=seikika((mg*cv).xyz),h=seikika(l+v);
float d=naiseki(n,l);if(d<0.)d=0.;
float s=naiseki(n,h);if(s<0.)s=0.;
vc=kamb*lamb+d*kdiff*ldiff+pow(s,kshi)*kspec*lspec;
gl_Position=mc*pv;
}
