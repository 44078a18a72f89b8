// The spook program: `spook run SCENE`, `spook play SCENE` and `spook scenes`.
//
// Exit status: 0, done; 1, the run diverged or could not be finished; 2, an invalid call. Errors are one line on
// stderr.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>

#include "engine/support/did_you_mean.hpp"
#include "spook/play_command.hpp"
#include "spook/require_nothing_left.hpp"
#include "spook/run_command.hpp"
#include "spook/scenes_command.hpp"

/// Adds the options that run and play share.
static CLI::App* add_scene_command(CLI::App& app, const std::string& name, const std::string& what,
                                   spook::RunCommand& run) {
  CLI::App* const command = app.add_subcommand(name, what);
  command->allow_extras();
  command->add_option("SCENE", run.scene, "A scene of ./course scenes, or a file.json")->required();
  command->add_option("--set", run.set, "Parameters of the scene, NAME=VALUE ...")->expected(1, 1000);
  command->add_option("--h", run.h, "Time step [s], such as 0.02 or 1/60");
  command->add_option("--time", run.time, "Simulated time [s]");
  command->add_option("--solver", run.solver, "A solver of ./course scenes");
  command->add_option("--iterations", run.iterations, "Maximum solver iterations per step");
  command->add_option("--tolerance", run.tolerance, "Residual at which sweeps stop [m/s] (default: 0)");
  command->add_option("--accuracy", run.accuracy, "What a solve by auto may leave, such as 1e-9");
  command->add_option("--substeps", run.substeps, "Number of substeps in a step");
  command->add_option("--row-order", run.row_order, "Order of rows: given, up, down, random, interleaved");
  command->add_option("--seed", run.seed, "Seed of a random order");
  command->add_flag("--warm-start", run.warm_start, "Start from the impulses of the last step");
  command->add_option("--contact-margin", run.contact_margin, "Largest gap of a contact [m]");
  command->add_option("--friction-model", run.friction_model, "Limits of friction: box, two_pass, cone");
  command->add_option("--tangents", run.tangents, "Directions of friction: fixed, sliding");
  command->add_option("--max-parts", run.max_parts, "Most parts into which a step is divided, up to 1024");
  command->add_option("--threads", run.threads, "Number of worker threads");
  command->add_option("--soft-steps", run.soft_steps, "Soft steps, as in game engines: number of substeps");
  command->add_option("--engine", run.engine, "fast, or plain: the steps of chapters 01 to 09");
  return command;
}

static void add_run(CLI::App& app, spook::RunCommand& run) {
  CLI::App* const command =
      add_scene_command(app, "run", "Run a scene and compare it with its known answer", run);
  command->add_option("--integrator-order", run.integrator_order,
                      "Order of a step: 2, or 4, composed of five leapfrogs");
  command->add_option("--csv", run.csv, "Write every step to this file");
  command->add_flag("--positions", run.positions, "With --csv: add the positions of all bodies");
  command->add_option("--record", run.record, "Write a recording, for view, to this file");
  command->add_option("--fps", run.fps, "With --record: frames per second (default: 60)");
  command->add_option("--checkpoint", run.checkpoint, "Save the state to this file each minute and at the end");
  command->add_option("--restart", run.restart, "Continue the run of a checkpoint");
  command->add_flag("--json", run.json, "Print one JSON object");
  command->add_flag("-v,--verbose", run.verbose, "Print parameters, answer, stages and counts, too");
  command->add_flag("--strict", run.strict, "Fail unless the run is sound: solved, and not lost");
}

static void add_play(CLI::App& app, spook::PlayCommand& play) {
  CLI::App* const command =
      add_scene_command(app, "play", "Run a scene in real time, for a page that shows it", play.run);
  command->add_option("--fps", play.run.fps, "Frames per second (default: 60)");
}

static void add_scenes(CLI::App& app, spook::ScenesCommand& scenes) {
  CLI::App* const command = app.add_subcommand("scenes", "List the scenes, their parameters, known answers");
  command->allow_extras();
  command->add_option("SCENE", scenes.scene, "List this scene only");
  command->add_flag("--json", scenes.json, "Print one JSON object");
  command->add_flag("--export", scenes.as_file, "Print the scene as a file for run, view and play");
  command->add_option("--set", scenes.set, "Parameters of the exported scene")->expected(1, 1000);
}

/// Throws std::invalid_argument for an -h that could mean either; CLI11 would report a missing scene first.
static void refuse_short_help(int argc, char** argv) {
  if (std::find(argv, argv + argc, std::string("-h")) != argv + argc)
    throw std::invalid_argument("-h is not an option: use --help for help, or run's --h for the time step");
}

static void require_command(const CLI::App& app) {
  if (!app.get_subcommands().empty()) return;
  if (app.remaining().empty())
    throw std::invalid_argument("a command is missing; the commands are run, play, scenes");
  const std::string given = app.remaining().front();
  throw std::invalid_argument("unknown command \"" + given + "\"" +
                              spook::did_you_mean(given, {"run", "play", "scenes"}));
}

static int complain(int status, const std::string& what) {
  std::cerr << "spook: " << what << '\n';
  return status;
}

/// Returns CLI11's message about the number of an option's values in words.
static std::string in_words(const CLI::ArgumentMismatch& error) {
  const std::string what = error.what(), option = what.substr(0, what.find(": "));
  if (what.find(": At Most 1") != std::string::npos) return option + " is given twice: leave one out";
  if (what.find(" missing") != std::string::npos || what.find(": At least") != std::string::npos)
    return option + " needs a value";
  return what;
}

int main(int argc, char** argv) {
  CLI::App app("A rigid-body engine by the SPOOK method: scenes with known answers.", "spook");
  app.set_help_flag("--help", "Print this help and exit");  // not -h, which CLI11 takes for --h, too
  app.get_formatter()->column_width(26);                    // so that no line is wider than a terminal
  app.require_subcommand(0, 1);
  app.allow_extras();
  spook::RunCommand run;
  spook::PlayCommand play;
  spook::ScenesCommand scenes;
  add_run(app, run);
  add_play(app, play);
  add_scenes(app, scenes);

  try {
    refuse_short_help(argc, argv);
    app.parse(argc, argv);
    require_command(app);
    spook::require_nothing_left(*app.get_subcommands().front());
    if (app.got_subcommand("run"))
      run.execute(std::cout);
    else if (app.got_subcommand("play"))
      play.execute(std::cout);
    else
      scenes.execute(std::cout);
    if (!std::cout.flush()) return complain(1, "standard output could not be written");
    return 0;
  } catch (const CLI::Success& asked) {
    return app.exit(asked);
  } catch (const CLI::ArgumentMismatch& error) {
    return complain(2, in_words(error));
  } catch (const CLI::ParseError& error) {
    return complain(2, error.what());
  } catch (const std::invalid_argument& error) {
    return complain(2, error.what());
  } catch (const std::exception& error) {
    return complain(1, error.what());
  }
}
