#version 410 core
// One name, five hundred functions.
const vec4 pl = vec4(0.0, 0.0, 1.0, 0.0);
const vec4 lamb = vec4(0.2, 0.2, 0.2, 1.0);
const vec4 ldiff = vec4(1.0, 1.0, 1.0, 0.0);
const vec4 lspec = vec4(1.0, 1.0, 1.0, 0.0);
const vec4 kamb = vec4(0.6, 0.0, 0.0, 1.0);
const vec4 kdiff = vec4(0.6, 0.0, 0.0, 1.0);
const vec4 kspec = vec4(0.4, 0.4, 0.4, 1.0);
const float kshi = 80.0;
layout (location = 0) in vec4 pv;
in vec4 cv;
uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;
out vec4 vc;

struct T0 { float x; };
float f(T0 t) { return t.x; }
struct T1 { float x; };
float f(T1 t) { return t.x; }
struct T2 { float x; };
float f(T2 t) { return t.x; }
struct T3 { float x; };
float f(T3 t) { return t.x; }
struct T4 { float x; };
float f(T4 t) { return t.x; }
struct T5 { float x; };
float f(T5 t) { return t.x; }
struct T6 { float x; };
float f(T6 t) { return t.x; }
struct T7 { float x; };
float f(T7 t) { return t.x; }
struct T8 { float x; };
float f(T8 t) { return t.x; }
struct T9 { float x; };
float f(T9 t) { return t.x; }
struct T10 { float x; };
float f(T10 t) { return t.x; }
struct T11 { float x; };
float f(T11 t) { return t.x; }
struct T12 { float x; };
float f(T12 t) { return t.x; }
struct T13 { float x; };
float f(T13 t) { return t.x; }
struct T14 { float x; };
float f(T14 t) { return t.x; }
struct T15 { float x; };
float f(T15 t) { return t.x; }
struct T16 { float x; };
float f(T16 t) { return t.x; }
struct T17 { float x; };
float f(T17 t) { return t.x; }
struct T18 { float x; };
float f(T18 t) { return t.x; }
struct T19 { float x; };
float f(T19 t) { return t.x; }
struct T20 { float x; };
float f(T20 t) { return t.x; }
struct T21 { float x; };
float f(T21 t) { return t.x; }
struct T22 { float x; };
float f(T22 t) { return t.x; }
struct T23 { float x; };
float f(T23 t) { return t.x; }
struct T24 { float x; };
float f(T24 t) { return t.x; }
struct T25 { float x; };
float f(T25 t) { return t.x; }
struct T26 { float x; };
float f(T26 t) { return t.x; }
struct T27 { float x; };
float f(T27 t) { return t.x; }
struct T28 { float x; };
float f(T28 t) { return t.x; }
struct T29 { float x; };
float f(T29 t) { return t.x; }
struct T30 { float x; };
float f(T30 t) { return t.x; }
struct T31 { float x; };
float f(T31 t) { return t.x; }
struct T32 { float x; };
float f(T32 t) { return t.x; }
struct T33 { float x; };
float f(T33 t) { return t.x; }
struct T34 { float x; };
float f(T34 t) { return t.x; }
struct T35 { float x; };
float f(T35 t) { return t.x; }
struct T36 { float x; };
float f(T36 t) { return t.x; }
struct T37 { float x; };
float f(T37 t) { return t.x; }
struct T38 { float x; };
float f(T38 t) { return t.x; }
struct T39 { float x; };
float f(T39 t) { return t.x; }
struct T40 { float x; };
float f(T40 t) { return t.x; }
struct T41 { float x; };
float f(T41 t) { return t.x; }
struct T42 { float x; };
float f(T42 t) { return t.x; }
struct T43 { float x; };
float f(T43 t) { return t.x; }
struct T44 { float x; };
float f(T44 t) { return t.x; }
struct T45 { float x; };
float f(T45 t) { return t.x; }
struct T46 { float x; };
float f(T46 t) { return t.x; }
struct T47 { float x; };
float f(T47 t) { return t.x; }
struct T48 { float x; };
float f(T48 t) { return t.x; }
struct T49 { float x; };
float f(T49 t) { return t.x; }
struct T50 { float x; };
float f(T50 t) { return t.x; }
struct T51 { float x; };
float f(T51 t) { return t.x; }
struct T52 { float x; };
float f(T52 t) { return t.x; }
struct T53 { float x; };
float f(T53 t) { return t.x; }
struct T54 { float x; };
float f(T54 t) { return t.x; }
struct T55 { float x; };
float f(T55 t) { return t.x; }
struct T56 { float x; };
float f(T56 t) { return t.x; }
struct T57 { float x; };
float f(T57 t) { return t.x; }
struct T58 { float x; };
float f(T58 t) { return t.x; }
struct T59 { float x; };
float f(T59 t) { return t.x; }
struct T60 { float x; };
float f(T60 t) { return t.x; }
struct T61 { float x; };
float f(T61 t) { return t.x; }
struct T62 { float x; };
float f(T62 t) { return t.x; }
struct T63 { float x; };
float f(T63 t) { return t.x; }
struct T64 { float x; };
float f(T64 t) { return t.x; }
struct T65 { float x; };
float f(T65 t) { return t.x; }
struct T66 { float x; };
float f(T66 t) { return t.x; }
struct T67 { float x; };
float f(T67 t) { return t.x; }
struct T68 { float x; };
float f(T68 t) { return t.x; }
struct T69 { float x; };
float f(T69 t) { return t.x; }
struct T70 { float x; };
float f(T70 t) { return t.x; }
struct T71 { float x; };
float f(T71 t) { return t.x; }
struct T72 { float x; };
float f(T72 t) { return t.x; }
struct T73 { float x; };
float f(T73 t) { return t.x; }
struct T74 { float x; };
float f(T74 t) { return t.x; }
struct T75 { float x; };
float f(T75 t) { return t.x; }
struct T76 { float x; };
float f(T76 t) { return t.x; }
struct T77 { float x; };
float f(T77 t) { return t.x; }
struct T78 { float x; };
float f(T78 t) { return t.x; }
struct T79 { float x; };
float f(T79 t) { return t.x; }
struct T80 { float x; };
float f(T80 t) { return t.x; }
struct T81 { float x; };
float f(T81 t) { return t.x; }
struct T82 { float x; };
float f(T82 t) { return t.x; }
struct T83 { float x; };
float f(T83 t) { return t.x; }
struct T84 { float x; };
float f(T84 t) { return t.x; }
struct T85 { float x; };
float f(T85 t) { return t.x; }
struct T86 { float x; };
float f(T86 t) { return t.x; }
struct T87 { float x; };
float f(T87 t) { return t.x; }
struct T88 { float x; };
float f(T88 t) { return t.x; }
struct T89 { float x; };
float f(T89 t) { return t.x; }
struct T90 { float x; };
float f(T90 t) { return t.x; }
struct T91 { float x; };
float f(T91 t) { return t.x; }
struct T92 { float x; };
float f(T92 t) { return t.x; }
struct T93 { float x; };
float f(T93 t) { return t.x; }
struct T94 { float x; };
float f(T94 t) { return t.x; }
struct T95 { float x; };
float f(T95 t) { return t.x; }
struct T96 { float x; };
float f(T96 t) { return t.x; }
struct T97 { float x; };
float f(T97 t) { return t.x; }
struct T98 { float x; };
float f(T98 t) { return t.x; }
struct T99 { float x; };
float f(T99 t) { return t.x; }
struct T100 { float x; };
float f(T100 t) { return t.x; }
struct T101 { float x; };
float f(T101 t) { return t.x; }
struct T102 { float x; };
float f(T102 t) { return t.x; }
struct T103 { float x; };
float f(T103 t) { return t.x; }
struct T104 { float x; };
float f(T104 t) { return t.x; }
struct T105 { float x; };
float f(T105 t) { return t.x; }
struct T106 { float x; };
float f(T106 t) { return t.x; }
struct T107 { float x; };
float f(T107 t) { return t.x; }
struct T108 { float x; };
float f(T108 t) { return t.x; }
struct T109 { float x; };
float f(T109 t) { return t.x; }
struct T110 { float x; };
float f(T110 t) { return t.x; }
struct T111 { float x; };
float f(T111 t) { return t.x; }
struct T112 { float x; };
float f(T112 t) { return t.x; }
struct T113 { float x; };
float f(T113 t) { return t.x; }
struct T114 { float x; };
float f(T114 t) { return t.x; }
struct T115 { float x; };
float f(T115 t) { return t.x; }
struct T116 { float x; };
float f(T116 t) { return t.x; }
struct T117 { float x; };
float f(T117 t) { return t.x; }
struct T118 { float x; };
float f(T118 t) { return t.x; }
struct T119 { float x; };
float f(T119 t) { return t.x; }
struct T120 { float x; };
float f(T120 t) { return t.x; }
struct T121 { float x; };
float f(T121 t) { return t.x; }
struct T122 { float x; };
float f(T122 t) { return t.x; }
struct T123 { float x; };
float f(T123 t) { return t.x; }
struct T124 { float x; };
float f(T124 t) { return t.x; }
struct T125 { float x; };
float f(T125 t) { return t.x; }
struct T126 { float x; };
float f(T126 t) { return t.x; }
struct T127 { float x; };
float f(T127 t) { return t.x; }
struct T128 { float x; };
float f(T128 t) { return t.x; }
struct T129 { float x; };
float f(T129 t) { return t.x; }
struct T130 { float x; };
float f(T130 t) { return t.x; }
struct T131 { float x; };
float f(T131 t) { return t.x; }
struct T132 { float x; };
float f(T132 t) { return t.x; }
struct T133 { float x; };
float f(T133 t) { return t.x; }
struct T134 { float x; };
float f(T134 t) { return t.x; }
struct T135 { float x; };
float f(T135 t) { return t.x; }
struct T136 { float x; };
float f(T136 t) { return t.x; }
struct T137 { float x; };
float f(T137 t) { return t.x; }
struct T138 { float x; };
float f(T138 t) { return t.x; }
struct T139 { float x; };
float f(T139 t) { return t.x; }
struct T140 { float x; };
float f(T140 t) { return t.x; }
struct T141 { float x; };
float f(T141 t) { return t.x; }
struct T142 { float x; };
float f(T142 t) { return t.x; }
struct T143 { float x; };
float f(T143 t) { return t.x; }
struct T144 { float x; };
float f(T144 t) { return t.x; }
struct T145 { float x; };
float f(T145 t) { return t.x; }
struct T146 { float x; };
float f(T146 t) { return t.x; }
struct T147 { float x; };
float f(T147 t) { return t.x; }
struct T148 { float x; };
float f(T148 t) { return t.x; }
struct T149 { float x; };
float f(T149 t) { return t.x; }
struct T150 { float x; };
float f(T150 t) { return t.x; }
struct T151 { float x; };
float f(T151 t) { return t.x; }
struct T152 { float x; };
float f(T152 t) { return t.x; }
struct T153 { float x; };
float f(T153 t) { return t.x; }
struct T154 { float x; };
float f(T154 t) { return t.x; }
struct T155 { float x; };
float f(T155 t) { return t.x; }
struct T156 { float x; };
float f(T156 t) { return t.x; }
struct T157 { float x; };
float f(T157 t) { return t.x; }
struct T158 { float x; };
float f(T158 t) { return t.x; }
struct T159 { float x; };
float f(T159 t) { return t.x; }
struct T160 { float x; };
float f(T160 t) { return t.x; }
struct T161 { float x; };
float f(T161 t) { return t.x; }
struct T162 { float x; };
float f(T162 t) { return t.x; }
struct T163 { float x; };
float f(T163 t) { return t.x; }
struct T164 { float x; };
float f(T164 t) { return t.x; }
struct T165 { float x; };
float f(T165 t) { return t.x; }
struct T166 { float x; };
float f(T166 t) { return t.x; }
struct T167 { float x; };
float f(T167 t) { return t.x; }
struct T168 { float x; };
float f(T168 t) { return t.x; }
struct T169 { float x; };
float f(T169 t) { return t.x; }
struct T170 { float x; };
float f(T170 t) { return t.x; }
struct T171 { float x; };
float f(T171 t) { return t.x; }
struct T172 { float x; };
float f(T172 t) { return t.x; }
struct T173 { float x; };
float f(T173 t) { return t.x; }
struct T174 { float x; };
float f(T174 t) { return t.x; }
struct T175 { float x; };
float f(T175 t) { return t.x; }
struct T176 { float x; };
float f(T176 t) { return t.x; }
struct T177 { float x; };
float f(T177 t) { return t.x; }
struct T178 { float x; };
float f(T178 t) { return t.x; }
struct T179 { float x; };
float f(T179 t) { return t.x; }
struct T180 { float x; };
float f(T180 t) { return t.x; }
struct T181 { float x; };
float f(T181 t) { return t.x; }
struct T182 { float x; };
float f(T182 t) { return t.x; }
struct T183 { float x; };
float f(T183 t) { return t.x; }
struct T184 { float x; };
float f(T184 t) { return t.x; }
struct T185 { float x; };
float f(T185 t) { return t.x; }
struct T186 { float x; };
float f(T186 t) { return t.x; }
struct T187 { float x; };
float f(T187 t) { return t.x; }
struct T188 { float x; };
float f(T188 t) { return t.x; }
struct T189 { float x; };
float f(T189 t) { return t.x; }
struct T190 { float x; };
float f(T190 t) { return t.x; }
struct T191 { float x; };
float f(T191 t) { return t.x; }
struct T192 { float x; };
float f(T192 t) { return t.x; }
struct T193 { float x; };
float f(T193 t) { return t.x; }
struct T194 { float x; };
float f(T194 t) { return t.x; }
struct T195 { float x; };
float f(T195 t) { return t.x; }
struct T196 { float x; };
float f(T196 t) { return t.x; }
struct T197 { float x; };
float f(T197 t) { return t.x; }
struct T198 { float x; };
float f(T198 t) { return t.x; }
struct T199 { float x; };
float f(T199 t) { return t.x; }
struct T200 { float x; };
float f(T200 t) { return t.x; }
struct T201 { float x; };
float f(T201 t) { return t.x; }
struct T202 { float x; };
float f(T202 t) { return t.x; }
struct T203 { float x; };
float f(T203 t) { return t.x; }
struct T204 { float x; };
float f(T204 t) { return t.x; }
struct T205 { float x; };
float f(T205 t) { return t.x; }
struct T206 { float x; };
float f(T206 t) { return t.x; }
struct T207 { float x; };
float f(T207 t) { return t.x; }
struct T208 { float x; };
float f(T208 t) { return t.x; }
struct T209 { float x; };
float f(T209 t) { return t.x; }
struct T210 { float x; };
float f(T210 t) { return t.x; }
struct T211 { float x; };
float f(T211 t) { return t.x; }
struct T212 { float x; };
float f(T212 t) { return t.x; }
struct T213 { float x; };
float f(T213 t) { return t.x; }
struct T214 { float x; };
float f(T214 t) { return t.x; }
struct T215 { float x; };
float f(T215 t) { return t.x; }
struct T216 { float x; };
float f(T216 t) { return t.x; }
struct T217 { float x; };
float f(T217 t) { return t.x; }
struct T218 { float x; };
float f(T218 t) { return t.x; }
struct T219 { float x; };
float f(T219 t) { return t.x; }
struct T220 { float x; };
float f(T220 t) { return t.x; }
struct T221 { float x; };
float f(T221 t) { return t.x; }
struct T222 { float x; };
float f(T222 t) { return t.x; }
struct T223 { float x; };
float f(T223 t) { return t.x; }
struct T224 { float x; };
float f(T224 t) { return t.x; }
struct T225 { float x; };
float f(T225 t) { return t.x; }
struct T226 { float x; };
float f(T226 t) { return t.x; }
struct T227 { float x; };
float f(T227 t) { return t.x; }
struct T228 { float x; };
float f(T228 t) { return t.x; }
struct T229 { float x; };
float f(T229 t) { return t.x; }
struct T230 { float x; };
float f(T230 t) { return t.x; }
struct T231 { float x; };
float f(T231 t) { return t.x; }
struct T232 { float x; };
float f(T232 t) { return t.x; }
struct T233 { float x; };
float f(T233 t) { return t.x; }
struct T234 { float x; };
float f(T234 t) { return t.x; }
struct T235 { float x; };
float f(T235 t) { return t.x; }
struct T236 { float x; };
float f(T236 t) { return t.x; }
struct T237 { float x; };
float f(T237 t) { return t.x; }
struct T238 { float x; };
float f(T238 t) { return t.x; }
struct T239 { float x; };
float f(T239 t) { return t.x; }
struct T240 { float x; };
float f(T240 t) { return t.x; }
struct T241 { float x; };
float f(T241 t) { return t.x; }
struct T242 { float x; };
float f(T242 t) { return t.x; }
struct T243 { float x; };
float f(T243 t) { return t.x; }
struct T244 { float x; };
float f(T244 t) { return t.x; }
struct T245 { float x; };
float f(T245 t) { return t.x; }
struct T246 { float x; };
float f(T246 t) { return t.x; }
struct T247 { float x; };
float f(T247 t) { return t.x; }
struct T248 { float x; };
float f(T248 t) { return t.x; }
struct T249 { float x; };
float f(T249 t) { return t.x; }
struct T250 { float x; };
float f(T250 t) { return t.x; }
struct T251 { float x; };
float f(T251 t) { return t.x; }
struct T252 { float x; };
float f(T252 t) { return t.x; }
struct T253 { float x; };
float f(T253 t) { return t.x; }
struct T254 { float x; };
float f(T254 t) { return t.x; }
struct T255 { float x; };
float f(T255 t) { return t.x; }
struct T256 { float x; };
float f(T256 t) { return t.x; }
struct T257 { float x; };
float f(T257 t) { return t.x; }
struct T258 { float x; };
float f(T258 t) { return t.x; }
struct T259 { float x; };
float f(T259 t) { return t.x; }
struct T260 { float x; };
float f(T260 t) { return t.x; }
struct T261 { float x; };
float f(T261 t) { return t.x; }
struct T262 { float x; };
float f(T262 t) { return t.x; }
struct T263 { float x; };
float f(T263 t) { return t.x; }
struct T264 { float x; };
float f(T264 t) { return t.x; }
struct T265 { float x; };
float f(T265 t) { return t.x; }
struct T266 { float x; };
float f(T266 t) { return t.x; }
struct T267 { float x; };
float f(T267 t) { return t.x; }
struct T268 { float x; };
float f(T268 t) { return t.x; }
struct T269 { float x; };
float f(T269 t) { return t.x; }
struct T270 { float x; };
float f(T270 t) { return t.x; }
struct T271 { float x; };
float f(T271 t) { return t.x; }
struct T272 { float x; };
float f(T272 t) { return t.x; }
struct T273 { float x; };
float f(T273 t) { return t.x; }
struct T274 { float x; };
float f(T274 t) { return t.x; }
struct T275 { float x; };
float f(T275 t) { return t.x; }
struct T276 { float x; };
float f(T276 t) { return t.x; }
struct T277 { float x; };
float f(T277 t) { return t.x; }
struct T278 { float x; };
float f(T278 t) { return t.x; }
struct T279 { float x; };
float f(T279 t) { return t.x; }
struct T280 { float x; };
float f(T280 t) { return t.x; }
struct T281 { float x; };
float f(T281 t) { return t.x; }
struct T282 { float x; };
float f(T282 t) { return t.x; }
struct T283 { float x; };
float f(T283 t) { return t.x; }
struct T284 { float x; };
float f(T284 t) { return t.x; }
struct T285 { float x; };
float f(T285 t) { return t.x; }
struct T286 { float x; };
float f(T286 t) { return t.x; }
struct T287 { float x; };
float f(T287 t) { return t.x; }
struct T288 { float x; };
float f(T288 t) { return t.x; }
struct T289 { float x; };
float f(T289 t) { return t.x; }
struct T290 { float x; };
float f(T290 t) { return t.x; }
struct T291 { float x; };
float f(T291 t) { return t.x; }
struct T292 { float x; };
float f(T292 t) { return t.x; }
struct T293 { float x; };
float f(T293 t) { return t.x; }
struct T294 { float x; };
float f(T294 t) { return t.x; }
struct T295 { float x; };
float f(T295 t) { return t.x; }
struct T296 { float x; };
float f(T296 t) { return t.x; }
struct T297 { float x; };
float f(T297 t) { return t.x; }
struct T298 { float x; };
float f(T298 t) { return t.x; }
struct T299 { float x; };
float f(T299 t) { return t.x; }
struct T300 { float x; };
float f(T300 t) { return t.x; }
struct T301 { float x; };
float f(T301 t) { return t.x; }
struct T302 { float x; };
float f(T302 t) { return t.x; }
struct T303 { float x; };
float f(T303 t) { return t.x; }
struct T304 { float x; };
float f(T304 t) { return t.x; }
struct T305 { float x; };
float f(T305 t) { return t.x; }
struct T306 { float x; };
float f(T306 t) { return t.x; }
struct T307 { float x; };
float f(T307 t) { return t.x; }
struct T308 { float x; };
float f(T308 t) { return t.x; }
struct T309 { float x; };
float f(T309 t) { return t.x; }
struct T310 { float x; };
float f(T310 t) { return t.x; }
struct T311 { float x; };
float f(T311 t) { return t.x; }
struct T312 { float x; };
float f(T312 t) { return t.x; }
struct T313 { float x; };
float f(T313 t) { return t.x; }
struct T314 { float x; };
float f(T314 t) { return t.x; }
struct T315 { float x; };
float f(T315 t) { return t.x; }
struct T316 { float x; };
float f(T316 t) { return t.x; }
struct T317 { float x; };
float f(T317 t) { return t.x; }
struct T318 { float x; };
float f(T318 t) { return t.x; }
struct T319 { float x; };
float f(T319 t) { return t.x; }
struct T320 { float x; };
float f(T320 t) { return t.x; }
struct T321 { float x; };
float f(T321 t) { return t.x; }
struct T322 { float x; };
float f(T322 t) { return t.x; }
struct T323 { float x; };
float f(T323 t) { return t.x; }
struct T324 { float x; };
float f(T324 t) { return t.x; }
struct T325 { float x; };
float f(T325 t) { return t.x; }
struct T326 { float x; };
float f(T326 t) { return t.x; }
struct T327 { float x; };
float f(T327 t) { return t.x; }
struct T328 { float x; };
float f(T328 t) { return t.x; }
struct T329 { float x; };
float f(T329 t) { return t.x; }
struct T330 { float x; };
float f(T330 t) { return t.x; }
struct T331 { float x; };
float f(T331 t) { return t.x; }
struct T332 { float x; };
float f(T332 t) { return t.x; }
struct T333 { float x; };
float f(T333 t) { return t.x; }
struct T334 { float x; };
float f(T334 t) { return t.x; }
struct T335 { float x; };
float f(T335 t) { return t.x; }
struct T336 { float x; };
float f(T336 t) { return t.x; }
struct T337 { float x; };
float f(T337 t) { return t.x; }
struct T338 { float x; };
float f(T338 t) { return t.x; }
struct T339 { float x; };
float f(T339 t) { return t.x; }
struct T340 { float x; };
float f(T340 t) { return t.x; }
struct T341 { float x; };
float f(T341 t) { return t.x; }
struct T342 { float x; };
float f(T342 t) { return t.x; }
struct T343 { float x; };
float f(T343 t) { return t.x; }
struct T344 { float x; };
float f(T344 t) { return t.x; }
struct T345 { float x; };
float f(T345 t) { return t.x; }
struct T346 { float x; };
float f(T346 t) { return t.x; }
struct T347 { float x; };
float f(T347 t) { return t.x; }
struct T348 { float x; };
float f(T348 t) { return t.x; }
struct T349 { float x; };
float f(T349 t) { return t.x; }
struct T350 { float x; };
float f(T350 t) { return t.x; }
struct T351 { float x; };
float f(T351 t) { return t.x; }
struct T352 { float x; };
float f(T352 t) { return t.x; }
struct T353 { float x; };
float f(T353 t) { return t.x; }
struct T354 { float x; };
float f(T354 t) { return t.x; }
struct T355 { float x; };
float f(T355 t) { return t.x; }
struct T356 { float x; };
float f(T356 t) { return t.x; }
struct T357 { float x; };
float f(T357 t) { return t.x; }
struct T358 { float x; };
float f(T358 t) { return t.x; }
struct T359 { float x; };
float f(T359 t) { return t.x; }
struct T360 { float x; };
float f(T360 t) { return t.x; }
struct T361 { float x; };
float f(T361 t) { return t.x; }
struct T362 { float x; };
float f(T362 t) { return t.x; }
struct T363 { float x; };
float f(T363 t) { return t.x; }
struct T364 { float x; };
float f(T364 t) { return t.x; }
struct T365 { float x; };
float f(T365 t) { return t.x; }
struct T366 { float x; };
float f(T366 t) { return t.x; }
struct T367 { float x; };
float f(T367 t) { return t.x; }
struct T368 { float x; };
float f(T368 t) { return t.x; }
struct T369 { float x; };
float f(T369 t) { return t.x; }
struct T370 { float x; };
float f(T370 t) { return t.x; }
struct T371 { float x; };
float f(T371 t) { return t.x; }
struct T372 { float x; };
float f(T372 t) { return t.x; }
struct T373 { float x; };
float f(T373 t) { return t.x; }
struct T374 { float x; };
float f(T374 t) { return t.x; }
struct T375 { float x; };
float f(T375 t) { return t.x; }
struct T376 { float x; };
float f(T376 t) { return t.x; }
struct T377 { float x; };
float f(T377 t) { return t.x; }
struct T378 { float x; };
float f(T378 t) { return t.x; }
struct T379 { float x; };
float f(T379 t) { return t.x; }
struct T380 { float x; };
float f(T380 t) { return t.x; }
struct T381 { float x; };
float f(T381 t) { return t.x; }
struct T382 { float x; };
float f(T382 t) { return t.x; }
struct T383 { float x; };
float f(T383 t) { return t.x; }
struct T384 { float x; };
float f(T384 t) { return t.x; }
struct T385 { float x; };
float f(T385 t) { return t.x; }
struct T386 { float x; };
float f(T386 t) { return t.x; }
struct T387 { float x; };
float f(T387 t) { return t.x; }
struct T388 { float x; };
float f(T388 t) { return t.x; }
struct T389 { float x; };
float f(T389 t) { return t.x; }
struct T390 { float x; };
float f(T390 t) { return t.x; }
struct T391 { float x; };
float f(T391 t) { return t.x; }
struct T392 { float x; };
float f(T392 t) { return t.x; }
struct T393 { float x; };
float f(T393 t) { return t.x; }
struct T394 { float x; };
float f(T394 t) { return t.x; }
struct T395 { float x; };
float f(T395 t) { return t.x; }
struct T396 { float x; };
float f(T396 t) { return t.x; }
struct T397 { float x; };
float f(T397 t) { return t.x; }
struct T398 { float x; };
float f(T398 t) { return t.x; }
struct T399 { float x; };
float f(T399 t) { return t.x; }
struct T400 { float x; };
float f(T400 t) { return t.x; }
struct T401 { float x; };
float f(T401 t) { return t.x; }
struct T402 { float x; };
float f(T402 t) { return t.x; }
struct T403 { float x; };
float f(T403 t) { return t.x; }
struct T404 { float x; };
float f(T404 t) { return t.x; }
struct T405 { float x; };
float f(T405 t) { return t.x; }
struct T406 { float x; };
float f(T406 t) { return t.x; }
struct T407 { float x; };
float f(T407 t) { return t.x; }
struct T408 { float x; };
float f(T408 t) { return t.x; }
struct T409 { float x; };
float f(T409 t) { return t.x; }
struct T410 { float x; };
float f(T410 t) { return t.x; }
struct T411 { float x; };
float f(T411 t) { return t.x; }
struct T412 { float x; };
float f(T412 t) { return t.x; }
struct T413 { float x; };
float f(T413 t) { return t.x; }
struct T414 { float x; };
float f(T414 t) { return t.x; }
struct T415 { float x; };
float f(T415 t) { return t.x; }
struct T416 { float x; };
float f(T416 t) { return t.x; }
struct T417 { float x; };
float f(T417 t) { return t.x; }
struct T418 { float x; };
float f(T418 t) { return t.x; }
struct T419 { float x; };
float f(T419 t) { return t.x; }
struct T420 { float x; };
float f(T420 t) { return t.x; }
struct T421 { float x; };
float f(T421 t) { return t.x; }
struct T422 { float x; };
float f(T422 t) { return t.x; }
struct T423 { float x; };
float f(T423 t) { return t.x; }
struct T424 { float x; };
float f(T424 t) { return t.x; }
struct T425 { float x; };
float f(T425 t) { return t.x; }
struct T426 { float x; };
float f(T426 t) { return t.x; }
struct T427 { float x; };
float f(T427 t) { return t.x; }
struct T428 { float x; };
float f(T428 t) { return t.x; }
struct T429 { float x; };
float f(T429 t) { return t.x; }
struct T430 { float x; };
float f(T430 t) { return t.x; }
struct T431 { float x; };
float f(T431 t) { return t.x; }
struct T432 { float x; };
float f(T432 t) { return t.x; }
struct T433 { float x; };
float f(T433 t) { return t.x; }
struct T434 { float x; };
float f(T434 t) { return t.x; }
struct T435 { float x; };
float f(T435 t) { return t.x; }
struct T436 { float x; };
float f(T436 t) { return t.x; }
struct T437 { float x; };
float f(T437 t) { return t.x; }
struct T438 { float x; };
float f(T438 t) { return t.x; }
struct T439 { float x; };
float f(T439 t) { return t.x; }
struct T440 { float x; };
float f(T440 t) { return t.x; }
struct T441 { float x; };
float f(T441 t) { return t.x; }
struct T442 { float x; };
float f(T442 t) { return t.x; }
struct T443 { float x; };
float f(T443 t) { return t.x; }
struct T444 { float x; };
float f(T444 t) { return t.x; }
struct T445 { float x; };
float f(T445 t) { return t.x; }
struct T446 { float x; };
float f(T446 t) { return t.x; }
struct T447 { float x; };
float f(T447 t) { return t.x; }
struct T448 { float x; };
float f(T448 t) { return t.x; }
struct T449 { float x; };
float f(T449 t) { return t.x; }
struct T450 { float x; };
float f(T450 t) { return t.x; }
struct T451 { float x; };
float f(T451 t) { return t.x; }
struct T452 { float x; };
float f(T452 t) { return t.x; }
struct T453 { float x; };
float f(T453 t) { return t.x; }
struct T454 { float x; };
float f(T454 t) { return t.x; }
struct T455 { float x; };
float f(T455 t) { return t.x; }
struct T456 { float x; };
float f(T456 t) { return t.x; }
struct T457 { float x; };
float f(T457 t) { return t.x; }
struct T458 { float x; };
float f(T458 t) { return t.x; }
struct T459 { float x; };
float f(T459 t) { return t.x; }
struct T460 { float x; };
float f(T460 t) { return t.x; }
struct T461 { float x; };
float f(T461 t) { return t.x; }
struct T462 { float x; };
float f(T462 t) { return t.x; }
struct T463 { float x; };
float f(T463 t) { return t.x; }
struct T464 { float x; };
float f(T464 t) { return t.x; }
struct T465 { float x; };
float f(T465 t) { return t.x; }
struct T466 { float x; };
float f(T466 t) { return t.x; }
struct T467 { float x; };
float f(T467 t) { return t.x; }
struct T468 { float x; };
float f(T468 t) { return t.x; }
struct T469 { float x; };
float f(T469 t) { return t.x; }
struct T470 { float x; };
float f(T470 t) { return t.x; }
struct T471 { float x; };
float f(T471 t) { return t.x; }
struct T472 { float x; };
float f(T472 t) { return t.x; }
struct T473 { float x; };
float f(T473 t) { return t.x; }
struct T474 { float x; };
float f(T474 t) { return t.x; }
struct T475 { float x; };
float f(T475 t) { return t.x; }
struct T476 { float x; };
float f(T476 t) { return t.x; }
struct T477 { float x; };
float f(T477 t) { return t.x; }
struct T478 { float x; };
float f(T478 t) { return t.x; }
struct T479 { float x; };
float f(T479 t) { return t.x; }
struct T480 { float x; };
float f(T480 t) { return t.x; }
struct T481 { float x; };
float f(T481 t) { return t.x; }
struct T482 { float x; };
float f(T482 t) { return t.x; }
struct T483 { float x; };
float f(T483 t) { return t.x; }
struct T484 { float x; };
float f(T484 t) { return t.x; }
struct T485 { float x; };
float f(T485 t) { return t.x; }
struct T486 { float x; };
float f(T486 t) { return t.x; }
struct T487 { float x; };
float f(T487 t) { return t.x; }
struct T488 { float x; };
float f(T488 t) { return t.x; }
struct T489 { float x; };
float f(T489 t) { return t.x; }
struct T490 { float x; };
float f(T490 t) { return t.x; }
struct T491 { float x; };
float f(T491 t) { return t.x; }
struct T492 { float x; };
float f(T492 t) { return t.x; }
struct T493 { float x; };
float f(T493 t) { return t.x; }
struct T494 { float x; };
float f(T494 t) { return t.x; }
struct T495 { float x; };
float f(T495 t) { return t.x; }
struct T496 { float x; };
float f(T496 t) { return t.x; }
struct T497 { float x; };
float f(T497 t) { return t.x; }
struct T498 { float x; };
float f(T498 t) { return t.x; }
struct T499 { float x; };
float f(T499 t) { return t.x; }

void main(void)
{
  vec4 p = mw * pv;
  vec3 v = -normalize(p.xyz / p.w);
  vec3 l = normalize((pl * p.w - p * pl.w).xyz);
  vec3 n = normalize((mg * cv).xyz);
  vec3 h = normalize(l + v);
  vc = kamb * lamb + max(dot(n, l), 0.0) * kdiff * ldiff + pow(max(dot(n, h), 0.0), kshi) * kspec * lspec;
  gl_Position = mc * pv;
}
