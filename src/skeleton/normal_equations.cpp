#include "skeleton/normal_equations.h"

#include <sys/mman.h>

#include <algorithm>
#include <cstdlib>
#include <new>

#include "lascaux/field/compiled_field.h"
#include "skeleton/four.h"
#include "skeleton/index.h"

namespace lascaux {
namespace {

/// Adds `factor` times `values`, a multiple of four, to as many numbers.
[[gnu::always_inline]] inline void AddScaled(std::span<const double> values, double factor,
                                             double* to) {
  for (std::size_t i = 0; i < values.size(); i += 4)
    StoreFour(LoadFour(to + i) + factor * LoadFour(&values[i]), to + i);
}

[[gnu::always_inline]] inline void Add(const SparseRow& row, NormalEquations& sums) {
  std::span<const double> values = row.values;
  for (std::size_t r = 0; r < row.runs.size(); ++r) {
    const PlanarSample::Run& run = row.runs[r];
    const std::span<const double> own = values.first(Index(run.FilledUp()));
    values = values.subspan(own.size());
    for (std::size_t k = 0; k < Index(run.count); ++k) {
      const std::size_t j = Index(run.first) + k, aligned = k / 4 * 4;
      const double weighted = row.weight * own[k];
      sums.slope.data()[j] += weighted * row.residual;
      AddScaled(own.subspan(aligned), weighted,
                sums.At(j, Index(run.first) + aligned, own.size() - aligned));
      std::span<const double> rest = values;
      for (std::size_t below = r + 1; below < row.runs.size(); ++below) {
        const PlanarSample::Run& other = row.runs[below];
        const std::size_t size = Index(other.FilledUp());
        AddScaled(rest.first(size), weighted, sums.At(j, Index(other.first), size));
        rest = rest.subspan(size);
      }
    }
  }
}

// The same code twice. Without fused multiplications, which AVX2 by itself has not, the bits agree.
void AddBaseline(const SparseRow& row, NormalEquations& sums) { Add(row, sums); }
#if defined(__x86_64__)
[[gnu::target("avx2")]] void AddAvx2(const SparseRow& row, NormalEquations& sums) {
  Add(row, sums);
}
#else
constexpr auto AddAvx2 = AddBaseline;
#endif

}  // namespace

void LazyZeros::Free::operator()(double* data) const noexcept {
  if (mapped_bytes > 0) {
    munmap(data, mapped_bytes);
  } else {
    std::free(data);
  }
}

LazyZeros::LazyZeros(std::size_t count) : data_(nullptr, Free{0}) {
  constexpr std::size_t kLarge = std::size_t{4} << 20;
  const std::size_t bytes = count * sizeof(double);
  if (bytes < kLarge) {
    data_.reset(static_cast<double*>(std::calloc(count + 1, sizeof(double))));
    if (!data_) throw std::bad_alloc();
    return;
  }
  void* const mapped =
      mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (mapped == MAP_FAILED) throw std::bad_alloc();
  madvise(mapped, bytes, MADV_NOHUGEPAGE);  // only for speed and memory: whatever it says
  data_.get_deleter().mapped_bytes = bytes;
  data_.reset(static_cast<double*>(mapped));
}

NormalEquations::NormalEquations(int unknowns)
    : slope(Eigen::VectorXd::Zero(unknowns)),
      rows_((Index(unknowns) + 3 + kBlock - 1) / kBlock * kBlock),
      words_((rows_ / kBlock + 63) / 64),
      zeros_(rows_ * Index(unknowns)),
      touched_(words_ * Index(unknowns), 0) {}

void NormalEquations::Add(const NormalEquations& others) {
  slope += others.slope;
  for (std::size_t column = 0; column < static_cast<std::size_t>(slope.size()); ++column) {
    others.ForBlocks(column, [&](std::size_t first, const double* values) {
      double* const own = At(column, first, kBlock);
      for (std::size_t i = 0; i < kBlock; ++i) own[i] += values[i];
    });
  }
}

void NormalEquations::Clear() {
  slope.setZero();
  for (std::size_t column = 0; column < static_cast<std::size_t>(slope.size()); ++column) {
    ForBlocks(column, [&](std::size_t first, const double*) {
      std::fill_n(zeros_.data() + rows_ * column + first, kBlock, 0.0);
    });
  }
  std::fill(touched_.begin(), touched_.end(), 0);
}

void AddRow(const SparseRow& row, NormalEquations& sums) {
  static const auto add = BestIsa() == Isa::kBaseline ? AddBaseline : AddAvx2;
  add(row, sums);
}

}  // namespace lascaux
