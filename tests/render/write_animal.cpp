#include <openvdb/io/File.h>

#include "render/animal.h"

/// Writes the animal as a level set, for golden_test.py to draw: write_animal FILE.vdb.
int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const auto animal = lascaux::Animal(96);
  animal->setName("surface");
  openvdb::io::File(argv[1]).write({animal});
  return 0;
}
