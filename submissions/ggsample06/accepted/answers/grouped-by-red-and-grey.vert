#version 410
const vec4 pl=vec4(0.,0.,1.,0.);
const vec4 lamb=vec4(.2,.2,.2,1.), ldiff=vec4(1.,1.,1.,0.), lspec=vec4(1.,1.,1.,0.);
const vec4 kamb=vec4(.6,0.,0.,1.), kdiff=vec4(.6,0.,0.,1.), kspec=vec4(.4,.4,.4,1.);
const float kshi=80.;
in vec4 pv, cv;
uniform mat4 mw, mc, mg;
out vec4 vc;

void main(){
vec3 n=normalize((mg*cv).xyz),v=normalize(-(mw*pv).xyz),h=normalize(v+vec3(0.,0.,1.));
float r=.6*(.2+max(n.z,0.)),g=.4*pow(max(dot(n,h),0.),80.);
vc=vec4(r+g,g,g,1.);
gl_Position=mc*pv;
}
