# The C++ and CMake sources that the linters and the formatters go over. To be read with ".".
cpp_sources() {
  find cpp bindings bench examples tests \( -name '*.cpp' -o -name '*.hpp' -o -name '*.c' -o -name cdcr.h \) \
    -print | sort
}
cmake_sources() {
  find CMakeLists.txt cmake cpp bindings bench examples tests \
    \( -name CMakeLists.txt -o -name '*.cmake' \) -print | sort
}
