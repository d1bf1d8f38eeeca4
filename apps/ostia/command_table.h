#pragma once
/// \file All commands of the program: their options and how each is declared. A new one gets its lines here.

#include "chain/plugin.h"
#include "chain/run.h"
#include "cohort/cohort.h"
#include "commands.h"
#include "convert/deidentify.h"
#include "convert/filter.h"
#include "doctor/doctor.h"
#include "evaluate/evaluate.h"
#include "experiment/experiment.h"
#include "flow/ffr.h"
#include "flow/flow_result.h"
#include "flow/solver_case.h"
#include "measure/calcium.h"
#include "measure/compare.h"
#include "measure/dicom_objects.h"
#include "measure/fat.h"
#include "measure/measure.h"
#include "measure/report.h"
#include "measure/territories.h"
#include "motion/motion.h"
#include "pacs/pacs.h"
#include "tree/grow.h"
#include "tree/reconstruct.h"
#include "tree/skeleton.h"
#include "vessel/carry.h"
#include "vessel/extract.h"
#include "vessel/lumen.h"

#include "ostia/core/task_context.h"

#include <functional>

namespace CLI {
class App;
}

namespace ostia::app {

/// What the command that was asked for does.
using Run = std::function<ExitCode(const core::TaskContext&)>;

struct Commands {
  CommonOptions common;
  InfoOptions info;
  ImportOptions import;
  SegmentCommand segment;
  CenterlineCommand centerline;
  MeshCommand mesh;
  ConvertCommand convert;
  ModelCommand model;
  PhantomCommand phantom;
  EvaluateCommand evaluate;
  ExperimentCommand experiment;
  LumenModelCommand lumen;
  ReplayCommand replay;
  ReportCommand report;
  CalciumCommand calcium;
  CompareCommand compare;
  CarryCommand carry;
  FatCommand fat;
  TerritoriesCommand territories;
  DicomCommand dicom;
  DeidentifyCommand deidentify;
  FilterCommand filter;
  DoctorCommand doctor;
  SkeletonCommand skeleton;
  GrowCommand grow;
  ReconstructCommand reconstruct;
  MeasureCommand measure;
  ExtractCommand extract;
  RunCommand chain;
  BatchCommand batch;
  PluginCommand plugin;
  CaseCommand solver_case;
  ResultCommand result;
  FfrCommand ffr;
  MotionCommands motion;
  PacsCommands pacs;
  CohortCommands cohort;
};

/// Declares them all to the parser; parsing then fills `commands` and sets `run`.
void define(CLI::App& app, Commands& commands, Run& run);

}  // namespace ostia::app
