// What the tree finds is what a look at every item finds, whatever their sizes, and after they have moved.
#include "improve/sheet_tree.h"

#include <cmath>
#include <random>
#include <set>

#include "catch2.h"

using namespace gaussmesh;

namespace {

/// Boxes of 0.0001 to 10 A, most of them in a cube of 10 A.
class RandomItems {
 public:
  SheetTree::Item next() {
    SheetTree::Item item;
    const float width = std::pow(10.0f, exponent_(random_));
    for (int k = 0; k < 3; ++k) {
      item.box.lo[k] = anywhere_(random_);
      item.box.hi[k] = item.box.lo[k] + width * share_(random_);
      item.normal[k] = direction_(random_);
    }
    return item;
  }

  std::size_t number_below(std::size_t count) {
    return std::uniform_int_distribution<std::size_t>(0, count - 1)(random_);
  }

 private:
  std::mt19937 random_{5};
  std::uniform_real_distribution<float> anywhere_{-1.0f, 11.0f}, share_{0.0f, 1.0f}, direction_{-1.0f, 1.0f},
      exponent_{-4.0f, 1.0f};
};

std::set<std::uint32_t> found_by_tree(const SheetTree& tree, const SheetTree::Item& query) {
  std::set<std::uint32_t> found;
  tree.visit(query, [&](std::uint32_t number) {
    CHECK(found.insert(number).second);
    return false;
  });
  return found;
}

std::set<std::uint32_t> found_by_looking(const std::vector<SheetTree::Item>& items, const SheetTree::Item& query) {
  std::set<std::uint32_t> found;
  for (std::uint32_t i = 0; i < items.size(); ++i) {
    if (query.box.meets(items[i].box) && !are_of_one_sheet(query.normal, items[i].normal)) found.insert(i);
  }
  return found;
}

}  // namespace

TEST_CASE("the tree of sheets finds what meets a box and faces elsewhere") {
  RandomItems random;
  SheetTree tree(10.0f);
  std::vector<SheetTree::Item> items;
  CHECK(found_by_tree(tree, random.next()).empty());
  for (int i = 0; i < 500; ++i) {
    items.push_back(random.next());
    CHECK(tree.add(items.back()) == static_cast<std::uint32_t>(i));
  }
  std::size_t found = 0, of_one_sheet = 0;
  for (int i = 0; i < 1000; ++i) {
    CAPTURE(i);
    const std::size_t moved = random.number_below(items.size());
    items[moved] = random.next();
    tree.change(static_cast<std::uint32_t>(moved), items[moved]);
    SheetTree::Item query = random.next();
    const std::set<std::uint32_t> of_other_sheets = found_by_looking(items, query);
    CHECK(found_by_tree(tree, query) == of_other_sheets);
    query.normal = {0.0f, 0.0f, 0.0f};
    const std::set<std::uint32_t> all = found_by_looking(items, query);
    CHECK(found_by_tree(tree, query) == all);
    found += of_other_sheets.size();
    of_one_sheet += all.size() - of_other_sheets.size();
  }
  CHECK(found > 1000);
  CHECK(of_one_sheet > 100);
}

TEST_CASE("a visit to the tree of sheets ends where it is told to") {
  RandomItems random;
  SheetTree tree(10.0f);
  SheetTree::Item everywhere = random.next();
  for (int k = 0; k < 3; ++k) {
    everywhere.box.lo[k] = -1.0f;
    everywhere.box.hi[k] = 21.0f;
  }
  everywhere.normal = {0.0f, 0.0f, 0.0f};
  for (int i = 0; i < 100; ++i) tree.add(random.next());
  int visits = 0;
  CHECK(tree.visit(everywhere, [&](std::uint32_t) { return ++visits == 7; }));
  CHECK(visits == 7);
}
