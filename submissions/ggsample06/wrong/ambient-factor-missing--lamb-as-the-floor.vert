#version 410
const vec4 pl=vec4(0.,0.,1.,0.);
const vec4 lamb=vec4(.2,.2,.2,1.), ldiff=vec4(1.,1.,1.,0.), lspec=vec4(1.,1.,1.,0.);
const vec4 kamb=vec4(.6,0.,0.,1.), kdiff=vec4(.6,0.,0.,1.), kspec=vec4(.4,.4,.4,1.);
const float kshi=80.;
in vec4 pv, cv;
uniform mat4 mw, mc, mg;
out vec4 vc;

void main(){
vec3 n=normalize(vec3(mg*cv)),l=normalize(pl.xyz),v=normalize(-vec3(mw*pv)),h=normalize(l+v);
vc=lamb;
vc+=kdiff*ldiff*max(dot(n,l),0.);
vc+=kspec*lspec*pow(max(dot(n,h),0.),kshi);
gl_Position=mc*pv;
}
