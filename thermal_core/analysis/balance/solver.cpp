#include "analysis/balance/solver.h"

#include <algorithm>
#include <cfloat>
#include <chrono>
#include <memory>
#include <string>

#include <Cbc_C_Interface.h>
#include <fmt/format.h>

#if defined(__SANITIZE_ADDRESS__)
/// CoinUtils leaks memory in implied_free_action::presolve, a few hundred bytes in about one program in a hundred.
extern "C" const char* __lsan_default_suppressions() { return "leak:implied_free_action"; }
extern "C" const char* __lsan_default_options() { return "print_suppressions=0"; }
#endif

namespace thermal {
namespace {

using ModelHandle = std::unique_ptr<Cbc_Model, decltype(&Cbc_deleteModel)>;

/// The program in the solver's layout, column by column.
struct SparseColumns {
  std::vector<CoinBigIndex> begins;
  std::vector<int> rows;
  std::vector<double> factors;
};

SparseColumns by_columns(const IntegerProgram& program) {
  SparseColumns sparse;
  sparse.begins.assign(program.columns.size() + 1, 0);
  for (const auto& row : program.rows) {
    for (const auto& term : row.terms) ++sparse.begins[term.column + 1];
  }
  for (std::size_t i = 0; i < program.columns.size(); ++i) sparse.begins[i + 1] += sparse.begins[i];
  sparse.rows.resize(static_cast<std::size_t>(sparse.begins.back()));
  sparse.factors.resize(sparse.rows.size());
  std::vector<CoinBigIndex> next = sparse.begins;
  for (std::size_t i = 0; i < program.rows.size(); ++i) {
    for (const auto& term : program.rows[i].terms) {
      const auto place = static_cast<std::size_t>(next[term.column]++);
      sparse.rows[place] = static_cast<int>(i);
      sparse.factors[place] = term.factor;
    }
  }
  return sparse;
}

double clamped(double value) { return std::min(std::max(value, -DBL_MAX), DBL_MAX); }

/// Bounds in the solver's form.
struct Bounds {
  std::vector<double> lower;
  std::vector<double> upper;

  void add(double low, double high) {
    lower.push_back(clamped(low));
    upper.push_back(clamped(high));
  }
};

void load(Cbc_Model* model, const IntegerProgram& program) {
  Bounds columns;
  Bounds rows;
  std::vector<double> costs;
  for (const auto& column : program.columns) {
    columns.add(column.lower, column.upper);
    costs.push_back(column.cost);
  }
  for (const auto& row : program.rows) rows.add(row.lower, row.upper);
  const SparseColumns sparse = by_columns(program);
  const auto column_count = static_cast<int>(program.columns.size());
  Cbc_loadProblem(model, column_count, static_cast<int>(program.rows.size()), sparse.begins.data(),
                  sparse.rows.data(), sparse.factors.data(), columns.lower.data(), columns.upper.data(),
                  costs.data(), rows.lower.data(), rows.upper.data());
  for (int i = 0; i < column_count; ++i) {
    if (program.columns[static_cast<std::size_t>(i)].whole) Cbc_setInteger(model, i);
  }
}

void set_limits(Cbc_Model* model, const SolverLimits& limits) {
  const auto set = [model](const char* name, const std::string& value) {
    Cbc_setParameter(model, name, value.c_str());
  };
  set("log", "0");
  set("timeMode", "elapsed");
  set("threads", "0");
  set("randomCbcSeed", "1");
  set("randomSeed", "1");
  set("ratioGap", fmt::format("{}", limits.gap));
  set("allowableGap", "0");
  set("seconds", fmt::format("{}", limits.time_s));
  set("maxNodes", fmt::format("{}", limits.nodes));
}

}  // namespace

SolverResult solve(const IntegerProgram& program, const SolverLimits& limits) {
  const ModelHandle model(Cbc_newModel(), &Cbc_deleteModel);
  load(model.get(), program);
  set_limits(model.get(), limits);
  const auto begin = std::chrono::steady_clock::now();
  Cbc_solve(model.get());
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
  SolverResult result;
  const bool finished = Cbc_status(model.get()) == 0;
  const double* values = Cbc_bestSolution(model.get());
  if (Cbc_isProvenInfeasible(model.get()) != 0) {
    // CBC 2.10 also reports this when it runs out of time before it has solved the relaxed program.
    if (taken.count() < limits.time_s) result.end = SolverEnd::infeasible;
    return result;
  }
  result.bound = Cbc_getBestPossibleObjValue(model.get());
  if (values == nullptr) return result;
  result.end = finished ? SolverEnd::solved : SolverEnd::stopped;
  result.values.assign(values, values + program.columns.size());
  result.objective = Cbc_getObjValue(model.get());
  return result;
}

}  // namespace thermal
