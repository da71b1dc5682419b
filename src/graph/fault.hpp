// What is wrong with a pipeline.
#pragma once

#include <string>

namespace lucerna::graph {

enum class FaultKind {
  UnknownPass,
  UnknownPort,
  UnknownParameter,
  MissingInput,
  TypeMismatch,
  FormatMismatch,
  SizeMismatch,
  ReadBeforeWrite,
  ReadAfterUpdate,  // of typed data, which cannot be copied to keep the older version
  Cycle,
  DuplicateName,
  ValueOutOfRange,
  WrongValueType,
  UnusableValue,  // of the right type, but the pass cannot work with it
  OutputNeverRead,
  DisabledWithoutStandIn,
  ProducerChanged,
  MadeLater,  // what an optional input could read
  MissingFeature,
  UnsupportedFormat,
  BadOutput,
  EmptyPipeline,
  WrongFrequency,
  BadForm,  // the text is no pipeline: a key that does not exist, a value of another type
};
const char* nameOf(FaultKind kind);  // "MissingInput"

enum class Severity { Warning, Error };

// One fault: where, what was found, what was wanted, what to do.
struct Fault {
  FaultKind kind;
  Severity severity = Severity::Error;
  std::string place{};  // "deferred.js:12, pass 'Ao', input 'depth'"
  std::string found{}, wanted{}, remedy{};
  std::string text() const;  // without the severity
};

}  // namespace lucerna::graph
