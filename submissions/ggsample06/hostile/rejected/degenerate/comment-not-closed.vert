#version 410 core
/* すべてコメント
void main(void) { }
