#include <iostream>
#include <vector>

// 学籍番号 ６０２５６０００

int main(int argc, char *argv[])
{
  std::vector<float> data{ 1.0f, 2.0f, 3.0f };
  for (auto x : data) std::cout << x << std::endl;
  return 0;
}
