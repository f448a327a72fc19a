#version 410 core
#define main
#if 0
#endif
