#version 410 core
/*
	課題6  Gouraud shading
*/
in	vec4	pv;
in	vec4	cv;
out	vec4	vc;
uniform	mat4	mw;
uniform	mat4	mc;
uniform	mat4	mg;

const	vec4	pl	= vec4(0.0, 0.0, 1.0, 0.0);
const	vec4	lamb	= vec4(0.2, 0.2, 0.2, 1.0);
const	vec4	ldiff	= vec4(1.0, 1.0, 1.0, 0.0);
const	vec4	lspec	= vec4(1.0, 1.0, 1.0, 0.0);
const	vec4	kamb	= vec4(0.6, 0.0, 0.0, 1.0);
const	vec4	kdiff	= vec4(0.6, 0.0, 0.0, 1.0);
const	vec4	kspec	= vec4(0.4, 0.4, 0.4, 1.0);
const	float	kshi	= 80.0;

void main( void )
{
	vec4 p = mw * pv ;					// shiten zahyoukei no ichi
	vec3 v = - normalize( p.xyz / p.w ) ;			// shisen
	vec3 l = normalize( ( pl * p.w - p * pl.w ).xyz ) ;	// kousen
	vec3 n = normalize( ( mg * cv ).xyz ) ;			// housen
	vec3 h = normalize( l + v ) ;				// chuukan

	float k1 = max( dot( n , l ) , 0.0f ) ;
	float k2 = pow( max( dot( n , h ) , 0.0f ) , kshi ) ;

	vc = kamb * lamb			// kankyoukou
	   + kdiff * ldiff * k1			// kakusan hansha
	   + kspec * lspec * k2 ;		// kyoumen hansha

	gl_Position = mc * pv ;
}
