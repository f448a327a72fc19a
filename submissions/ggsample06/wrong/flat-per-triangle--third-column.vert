#version 410 core
const vec4 pl=vec4(0.,0.,1.,0.),lamb=vec4(.2,.2,.2,1.),ldiff=vec4(1.,1.,1.,0.),lspec=vec4(1.,1.,1.,0.);
const vec4 kamb=vec4(.6,0.,0.,1.),kdiff=vec4(.6,0.,0.,1.),kspec=vec4(.4,.4,.4,1.);
const float kshi=80.;
in vec4 pv,cv;
uniform mat4 mw,mc,mg;
out vec4 vc;
void main(){
vec3 v=-normalize((mw*pv).xyz),l=pl.xyz,n=normalize(mg[2].xyz),h=normalize(l+v);
vc=kamb*lamb+max(dot(n,l),0.)*kdiff*ldiff+pow(max(dot(n,h),0.),kshi)*kspec*lspec;
gl_Position=mc*pv;
}
