#include "skeleton/tree.h"

#include "skeleton/index.h"

namespace lascaux {

std::vector<std::vector<int>> Neighbours(const Skeleton& tree) {
  std::vector<std::vector<int>> neighbours(tree.vertices.size());
  for (const auto& [a, b] : tree.edges) {
    neighbours[Index(a)].push_back(b);
    neighbours[Index(b)].push_back(a);
  }
  return neighbours;
}

Skeleton Subtree(const Skeleton& tree, const std::vector<char>& keep) {
  Skeleton result;
  result.part = tree.part;
  std::vector<int> image(tree.vertices.size(), -1);
  for (std::size_t v = 0; v < tree.vertices.size(); ++v) {
    if (!keep[v]) continue;
    image[v] = static_cast<int>(result.vertices.size());
    result.vertices.push_back(tree.vertices[v]);
  }
  for (const auto& [a, b] : tree.edges) {
    if (image[Index(a)] >= 0 && image[Index(b)] >= 0)
      result.edges.push_back({image[Index(a)], image[Index(b)]});
  }
  return result;
}

std::vector<std::vector<int>> Paths(const Skeleton& tree) {
  const std::vector<std::vector<int>> neighbours = Neighbours(tree);
  std::vector<std::vector<int>> paths;
  for (std::size_t start = 0; start < neighbours.size(); ++start) {
    if (neighbours[start].size() == 2) continue;
    for (const int first : neighbours[start]) {
      std::vector<int> path{static_cast<int>(start), first};
      while (neighbours[Index(path.back())].size() == 2) {
        const auto& pair = neighbours[Index(path.back())];
        path.push_back(pair[0] == path[path.size() - 2] ? pair[1] : pair[0]);
      }
      // Each path is met from both of its ends.
      if (path.front() < path.back()) paths.push_back(std::move(path));
    }
  }
  return paths;
}

}  // namespace lascaux
