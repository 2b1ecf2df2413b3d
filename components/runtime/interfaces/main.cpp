#include <iostream>

#include "runtime/interfaces/markdown.hpp"

int main() {
  std::cout << coop::runtime::interfaces_markdown();
  return std::cout.good() ? 0 : 1;
}
