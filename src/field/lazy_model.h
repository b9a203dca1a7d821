// A local model that is made when somebody asks for it.
#pragma once

#include <optional>

#include "field/local_model.h"

namespace gaussmesh {

/// Stands for the model of a box: two cells in five, and most of their edges, are settled without it.
class LazyModel {
 public:
  /// The atoms live, and stay as they are, as long as this.
  LazyModel(const NearAtoms& atoms, double decay, const Box& box) : atoms_(&atoms), decay_(decay), box_(box) {}

  /// One that there is already, and that lives as long as this.
  LazyModel(const LocalModel& model) : box_(model.box()), model_(&model) {}  // NOLINT: it is one

  LazyModel(const LazyModel&) = delete;
  LazyModel& operator=(const LazyModel&) = delete;

  const Box& box() const { return box_; }
  const LocalModel& get() const {
    if (model_ == nullptr) model_ = &made_.emplace(*atoms_, decay_, box_);
    return *model_;
  }

 private:
  const NearAtoms* atoms_ = nullptr;
  double decay_ = 0.0;
  Box box_;
  mutable std::optional<LocalModel> made_;
  mutable const LocalModel* model_ = nullptr;
};

}  // namespace gaussmesh
