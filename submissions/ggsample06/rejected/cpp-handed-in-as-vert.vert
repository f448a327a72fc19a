#include <cmath>
#include <cstdlib>
#include <string>

using namespace std;

// 頂点配列オブジェクトを作る
class Object
{
  unsigned int vao;

public:
  Object() : vao(0) {}
  virtual ~Object() {}
  void draw() const {}
};

int main()
{
  Object object;
  object.draw();
  return EXIT_SUCCESS;
}
