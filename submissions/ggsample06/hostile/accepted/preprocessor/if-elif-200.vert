#version 410 core
// One condition with two hundred ways.
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
#if 0
#elif 0 == 1
#elif 0 == 2
#elif 0 == 3
#elif 0 == 4
#elif 0 == 5
#elif 0 == 6
#elif 0 == 7
#elif 0 == 8
#elif 0 == 9
#elif 0 == 10
#elif 0 == 11
#elif 0 == 12
#elif 0 == 13
#elif 0 == 14
#elif 0 == 15
#elif 0 == 16
#elif 0 == 17
#elif 0 == 18
#elif 0 == 19
#elif 0 == 20
#elif 0 == 21
#elif 0 == 22
#elif 0 == 23
#elif 0 == 24
#elif 0 == 25
#elif 0 == 26
#elif 0 == 27
#elif 0 == 28
#elif 0 == 29
#elif 0 == 30
#elif 0 == 31
#elif 0 == 32
#elif 0 == 33
#elif 0 == 34
#elif 0 == 35
#elif 0 == 36
#elif 0 == 37
#elif 0 == 38
#elif 0 == 39
#elif 0 == 40
#elif 0 == 41
#elif 0 == 42
#elif 0 == 43
#elif 0 == 44
#elif 0 == 45
#elif 0 == 46
#elif 0 == 47
#elif 0 == 48
#elif 0 == 49
#elif 0 == 50
#elif 0 == 51
#elif 0 == 52
#elif 0 == 53
#elif 0 == 54
#elif 0 == 55
#elif 0 == 56
#elif 0 == 57
#elif 0 == 58
#elif 0 == 59
#elif 0 == 60
#elif 0 == 61
#elif 0 == 62
#elif 0 == 63
#elif 0 == 64
#elif 0 == 65
#elif 0 == 66
#elif 0 == 67
#elif 0 == 68
#elif 0 == 69
#elif 0 == 70
#elif 0 == 71
#elif 0 == 72
#elif 0 == 73
#elif 0 == 74
#elif 0 == 75
#elif 0 == 76
#elif 0 == 77
#elif 0 == 78
#elif 0 == 79
#elif 0 == 80
#elif 0 == 81
#elif 0 == 82
#elif 0 == 83
#elif 0 == 84
#elif 0 == 85
#elif 0 == 86
#elif 0 == 87
#elif 0 == 88
#elif 0 == 89
#elif 0 == 90
#elif 0 == 91
#elif 0 == 92
#elif 0 == 93
#elif 0 == 94
#elif 0 == 95
#elif 0 == 96
#elif 0 == 97
#elif 0 == 98
#elif 0 == 99
#elif 0 == 100
#elif 0 == 101
#elif 0 == 102
#elif 0 == 103
#elif 0 == 104
#elif 0 == 105
#elif 0 == 106
#elif 0 == 107
#elif 0 == 108
#elif 0 == 109
#elif 0 == 110
#elif 0 == 111
#elif 0 == 112
#elif 0 == 113
#elif 0 == 114
#elif 0 == 115
#elif 0 == 116
#elif 0 == 117
#elif 0 == 118
#elif 0 == 119
#elif 0 == 120
#elif 0 == 121
#elif 0 == 122
#elif 0 == 123
#elif 0 == 124
#elif 0 == 125
#elif 0 == 126
#elif 0 == 127
#elif 0 == 128
#elif 0 == 129
#elif 0 == 130
#elif 0 == 131
#elif 0 == 132
#elif 0 == 133
#elif 0 == 134
#elif 0 == 135
#elif 0 == 136
#elif 0 == 137
#elif 0 == 138
#elif 0 == 139
#elif 0 == 140
#elif 0 == 141
#elif 0 == 142
#elif 0 == 143
#elif 0 == 144
#elif 0 == 145
#elif 0 == 146
#elif 0 == 147
#elif 0 == 148
#elif 0 == 149
#elif 0 == 150
#elif 0 == 151
#elif 0 == 152
#elif 0 == 153
#elif 0 == 154
#elif 0 == 155
#elif 0 == 156
#elif 0 == 157
#elif 0 == 158
#elif 0 == 159
#elif 0 == 160
#elif 0 == 161
#elif 0 == 162
#elif 0 == 163
#elif 0 == 164
#elif 0 == 165
#elif 0 == 166
#elif 0 == 167
#elif 0 == 168
#elif 0 == 169
#elif 0 == 170
#elif 0 == 171
#elif 0 == 172
#elif 0 == 173
#elif 0 == 174
#elif 0 == 175
#elif 0 == 176
#elif 0 == 177
#elif 0 == 178
#elif 0 == 179
#elif 0 == 180
#elif 0 == 181
#elif 0 == 182
#elif 0 == 183
#elif 0 == 184
#elif 0 == 185
#elif 0 == 186
#elif 0 == 187
#elif 0 == 188
#elif 0 == 189
#elif 0 == 190
#elif 0 == 191
#elif 0 == 192
#elif 0 == 193
#elif 0 == 194
#elif 0 == 195
#elif 0 == 196
#elif 0 == 197
#elif 0 == 198
#elif 0 == 199
#elif 0 == 200
#else
#endif
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
