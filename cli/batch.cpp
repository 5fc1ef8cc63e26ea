// SPDX-License-Identifier: GPL-3.0-or-later
// `toile batch`: one design, many bodies. Each order is made by a program of its own, so that
// nothing that happens to one can stop the others, and memory does not grow with their number.
#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "commands.h"
#include "terminal_progress.h"
#include "toile/batch/batch.h"
#include "toile/core/file.h"

extern char** environ;  // NOLINT: of the C library

namespace toile::cli {
namespace {

struct Arguments {
  std::filesystem::path design, bodies, out;
  std::size_t jobs = 0;
  std::optional<std::size_t> task;
  bool isCollecting = false;
};

/// Names the program that a task must not outlive: a batch that is killed leaves none behind that
/// would write into its folders beside those of the next run.
constexpr const char* kParentVariable = "TOILE_BATCH_PARENT";

void dieWithParent() {
  const char* parent = std::getenv(kParentVariable);
  if (parent == nullptr) return;
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (std::to_string(getppid()) != parent) std::_Exit(kFailed);
}

/// Starts `toile batch ... --task N` without a word on the terminal. @return its process, or -1
pid_t start(const Arguments& arguments, const Session& session, std::size_t task) {
  std::vector<std::string> words = {"toile",
                                    "batch",
                                    arguments.design.string(),
                                    "--bodies",
                                    arguments.bodies.string(),
                                    "-o",
                                    arguments.out.string(),
                                    "--task",
                                    std::to_string(task),
                                    "--threads",
                                    "1"};
  if (session.units) {
    words.emplace_back("--units");
    words.emplace_back(toString(*session.units));
  }
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  std::string parent = fmt::format("{}={}", kParentVariable, getpid());
  std::vector<char*> variables;
  for (char** variable = environ; *variable != nullptr; ++variable) variables.push_back(*variable);
  variables.push_back(parent.data());
  variables.push_back(nullptr);
  posix_spawn_file_actions_t quiet;
  posix_spawn_file_actions_init(&quiet);
  posix_spawn_file_actions_addopen(&quiet, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&quiet, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t process = -1;
  if (posix_spawn(&process, "/proc/self/exe", &quiet, nullptr, argv.data(), variables.data()) !=
      0) {
    process = -1;
  }
  posix_spawn_file_actions_destroy(&quiet);
  return process;
}

std::string describeEnd(int status) {
  if (WIFSIGNALED(status)) {
    return fmt::format("the program that made it was ended by signal {} ({})", WTERMSIG(status),
                       strsignal(WTERMSIG(status)));
  }
  return fmt::format("the program that made it ended with status {} and left no result",
                     WEXITSTATUS(status));
}

/// Makes what is open, `jobs` at a time.
Result<void> makeOpen(const Arguments& arguments, const Session& session,
                      const std::vector<BatchOrder>& orders, TerminalProgress& progress) {
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < orders.size(); ++i) {
    if (!findOutcome(arguments.design, orders[i], arguments.out)) open.push_back(i);
  }
  // The larger the file the longer the order; a long one begun last would leave cores idle.
  const auto bytes = [&](std::size_t order) {
    std::error_code isNoFile;
    const std::uintmax_t size = std::filesystem::file_size(orders[order].body, isNoFile);
    return isNoFile ? 0 : size;
  };
  std::stable_sort(open.begin(), open.end(),
                   [&](std::size_t a, std::size_t b) { return bytes(a) > bytes(b); });
  const std::size_t kept = orders.size() - open.size();
  if (kept > 0) progress.step(fmt::format("{} of {} orders are made already", kept, orders.size()));
  const std::size_t jobs = arguments.jobs > 0
                               ? arguments.jobs
                               : std::max<std::size_t>(1, std::thread::hardware_concurrency());
  std::map<pid_t, std::size_t> running;
  std::size_t next = 0;
  while (next < open.size() || !running.empty()) {
    while (next < open.size() && running.size() < jobs) {
      const std::size_t order = open[next++];
      progress.step(fmt::format("{} ({} of {})", orders[order].name, kept + next, orders.size()));
      const pid_t process = start(arguments, session, order);
      if (process < 0) {
        return Error{ErrorCode::Unsupported, "the system refuses to start another program", {}};
      }
      running[process] = order;
    }
    int status = 0;
    const pid_t ended = waitpid(-1, &status, 0);
    const auto found = running.find(ended);
    if (found == running.end()) continue;
    const BatchOrder& order = orders[found->second];
    running.erase(found);
    if (findOutcome(arguments.design, order, arguments.out)) continue;
    const Result<OrderOutcome> noted =
        failOrder(arguments.design, order, arguments.out, describeEnd(status));
    if (!noted) return noted.error();
  }
  return {};
}

int makeTask(const Arguments& arguments, const std::vector<BatchOrder>& orders) {
  dieWithParent();
  if (*arguments.task >= orders.size()) {
    return fail({ErrorCode::InvalidArgument,
                 fmt::format("--task {}: there are {} orders, counted from 0", *arguments.task,
                             orders.size()),
                 {}});
  }
  const BatchOrder& order = orders[*arguments.task];
  std::optional<OrderOutcome> outcome = findOutcome(arguments.design, order, arguments.out);
  if (!outcome) {
    TerminalProgress progress;
    Result<OrderOutcome> made = makeOrder(arguments.design, order, arguments.out, &progress);
    if (!made) return fail(made.error());
    outcome = *std::move(made);
  }
  fmt::print("{}: {}{}\n", outcome->name, outcome->status,
             outcome->reason.empty() ? "" : ": " + outcome->reason);
  return outcome->status == "done" ? kDone : kFailed;
}

int run(const Arguments& arguments, const Session& session) {
  // A design that cannot be read fails once and not for every order.
  if (const Result<std::string> text = readFile(arguments.design); !text) return fail(text.error());
  const Result<std::vector<BatchOrder>> orders = readOrders(arguments.bodies, session.units);
  if (!orders) return fail(orders.error());
  if (arguments.task) return makeTask(arguments, *orders);
  TerminalProgress progress;
  if (!arguments.isCollecting) {
    const Result<void> made = makeOpen(arguments, session, *orders, progress);
    if (!made) return fail(made.error());
  }
  const Result<std::size_t> open = collectOrders(arguments.design, *orders, arguments.out);
  if (!open) return fail(open.error());
  for (const BatchOrder& order : *orders) {
    const auto outcome = findOutcome(arguments.design, order, arguments.out);
    if (!outcome || outcome->status == "done") continue;
    fmt::print(stderr, "toile: {}: {}: {}\n", order.name, outcome->status, outcome->reason);
  }
  if (session.json) {
    const nlohmann::ordered_json json = {{"orders", orders->size()},
                                         {"done", orders->size() - *open},
                                         {"overview", (arguments.out / "index.html").string()},
                                         {"summary", (arguments.out / "summary.csv").string()}};
    fmt::print("{}\n", json.dump(2));
  } else {
    fmt::print("{} of {} orders done; {}\n", orders->size() - *open, orders->size(),
               (arguments.out / "index.html").string());
  }
  return *open == 0 ? kDone : kFailed;
}

}  // namespace

void addBatch(CLI::App& app, Session& session) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = addCommand(app, session, "batch", "One design for many bodies, resumable",
                                 [arguments, &session] { return run(*arguments, session); });
  command->add_option("DESIGN", arguments->design, "The design, a .toile file")->required();
  command
      ->add_option("--bodies", arguments->bodies,
                   "A folder of bodies, or a list: CSV with the columns body, name, customer, "
                   "size, units, landmarks")
      ->type_name("DIR|CSV")
      ->required();
  command->add_option("-o,--output", arguments->out, "Folder for the orders and the overview")
      ->type_name("DIR")
      ->required();
  command
      ->add_option("-j,--jobs", arguments->jobs,
                   "Orders made at the same time (default: as many as cores)")
      ->check(CLI::Range(1, 1024))
      ->type_name("N");
  command
      ->add_option("--task", arguments->task,
                   "Make the order of this number alone, counted from 0: for job arrays")
      ->type_name("N");
  command->add_flag("--collect", arguments->isCollecting,
                    "Make no orders, only the overview of those that are there");
}

}  // namespace toile::cli
