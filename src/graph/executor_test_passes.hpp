// Passes that do sums on textures of one value, so that every wrong texture shows as a wrong
// number. For the executor's tests.
#pragma once

#include <string>

#include "gpu/device.hpp"
#include "graph/pass_info.hpp"

namespace lucerna::graph::sums {

using gpu::Format;
using gpu::Texture;

struct Number {
  static constexpr const char* kPortName = "Number";
  float value = 0;
};

float valueOf(gpu::Device& device, const Texture& texture) {
  return device.download(texture).as<float>()[0];
}

// Instances alive and calls made, over all passes below.
int alive = 0, executed = 0;
struct Counted {
  Counted() { ++alive; }
  ~Counted() { --alive; }
  Counted(const Counted&) = delete;
  Counted& operator=(const Counted&) = delete;
};

struct AmountParams {
  float amount = 1;
};

class Constant : Counted {
 public:
  using Params = AmountParams;
  struct Ports {
    Out<Texture> a;
  };
  static void describe(PassInfo<Params, Ports>& d) {
    d.pass("Constant", "Writes one value.");
    d.param("amount", &Params::amount).range(0, 1000);
    d.write("a", &Ports::a).texture(Format::R32Float).whenDisabled(vec4(500));
  }
  explicit Constant(gpu::Device&) {}
  void execute(PassContext& context, const Params& params, const Ports& ports) {
    ++executed;
    context.device.clear(*ports.a, vec4(params.amount));
  }
};

class Once : Counted {
 public:
  using Params = AmountParams;
  struct Ports {
    Out<Texture> a;
  };
  static void describe(PassInfo<Params, Ports>& d) {
    d.pass("Once", "Writes how often it ran.");
    d.runs(Frequency::PerScene);
    d.param("amount", &Params::amount);
    d.write("a", &Ports::a).texture(Format::R32Float);
  }
  explicit Once(gpu::Device&) {}
  void execute(PassContext& context, const Params& params, const Ports& ports) {
    context.device.clear(*ports.a, vec4(params.amount * static_cast<float>(++runs_)));
  }

 private:
  int runs_ = 0;
};

class Add : Counted {
 public:
  using Params = AmountParams;
  struct Ports {
    In<Texture> in;
    Out<Texture> out;
  };
  static void describe(PassInfo<Params, Ports>& d) {
    d.pass("Add", "Adds to what it reads.");
    d.param("amount", &Params::amount);
    d.read("a", &Ports::in).texture(Format::R32Float);
    d.write("a", &Ports::out).texture(Format::R32Float).sizeOf("a").passesThrough("a");
  }
  explicit Add(gpu::Device&) {}
  void execute(PassContext& context, const Params& params, const Ports& ports) {
    const float value = valueOf(context.device, *ports.in);
    context.device.clear(*ports.out, vec4(value + params.amount));
  }
};

class AddInPlace : Counted {
 public:
  using Params = AmountParams;
  struct Ports {
    InOut<Texture> a;
  };
  static void describe(PassInfo<Params, Ports>& d) {
    d.pass("AddInPlace", "Adds to what it updates.");
    d.param("amount", &Params::amount);
    d.update("a", &Ports::a).texture(Format::R32Float);
  }
  explicit AddInPlace(gpu::Device&) {}
  void execute(PassContext& context, const Params& params, const Ports& ports) {
    context.device.clear(*ports.a, vec4(valueOf(context.device, *ports.a) + params.amount));
  }
};

class AddOrStart : Counted {
 public:
  using Params = AmountParams;
  struct Ports {
    InOut<Texture> a;
  };
  static void describe(PassInfo<Params, Ports>& d) {
    d.pass("AddOrStart", "Adds to what it updates, or starts at zero.");
    d.param("amount", &Params::amount);
    d.update("a", &Ports::a)
        .texture(Format::R32Float)
        .sizeOfOutput()
        .optional()
        .whenDisabled(vec4(7));
  }
  explicit AddOrStart(gpu::Device&) {}
  void execute(PassContext& context, const Params& params, const Ports& ports) {
    const float before = ports.a.isNew() ? 0.f : valueOf(context.device, *ports.a);
    context.device.clear(*ports.a, vec4(before + params.amount));
  }
};

class Sum : Counted {
 public:
  struct Params {};
  struct Ports {
    In<Texture> a, b;
    Out<Texture> out;
  };
  static void describe(PassInfo<Params, Ports>& d) {
    d.pass("Sum", "Adds two.");
    d.read("a", &Ports::a).texture(Format::R32Float);
    d.read("b", &Ports::b).texture(Format::R32Float);
    d.write("a", &Ports::out).texture(Format::R32Float);
  }
  explicit Sum(gpu::Device&) {}
  void execute(PassContext& context, const Params&, const Ports& ports) {
    context.device.clear(
        *ports.out, vec4(valueOf(context.device, *ports.a) + valueOf(context.device, *ports.b)));
  }
};

// a = resource number + last frame's a; -1 if there is none.
class Accumulate : Counted {
 public:
  struct Params {};
  struct Ports {
    In<Number> number;
    In<Texture> past;
    Out<Texture> a;
  };
  static void describe(PassInfo<Params, Ports>& d) {
    d.pass("Accumulate", "Adds a resource to last frame's value.");
    d.read("number", &Ports::number);
    d.read("past", &Ports::past).texture(Format::R32Float).history();
    d.write("a", &Ports::a).texture(Format::R32Float);
  }
  explicit Accumulate(gpu::Device&) {}
  void execute(PassContext& context, const Params&, const Ports& ports) {
    const float past = ports.past ? valueOf(context.device, *ports.past) : -1;
    context.device.clear(*ports.a, vec4(ports.number->value + past));
  }
};

class MakeNumber : Counted {
 public:
  using Params = AmountParams;
  struct Ports {
    Out<Number> data;
  };
  static void describe(PassInfo<Params, Ports>& d) {
    d.pass("MakeNumber", "Counts its frames in typed data.");
    d.param("amount", &Params::amount);
    d.write("data", &Ports::data);
  }
  explicit MakeNumber(gpu::Device&) {}
  void execute(PassContext&, const Params& params, const Ports& ports) {
    ports.data->value += params.amount;
  }
};

class ShowNumber : Counted {
 public:
  struct Params {};
  struct Ports {
    In<Number> data;
    Out<Texture> a;
  };
  static void describe(PassInfo<Params, Ports>& d) {
    d.pass("ShowNumber", "Writes typed data to a texture.");
    d.read("data", &Ports::data);
    d.write("a", &Ports::a).texture(Format::R32Float);
  }
  explicit ShowNumber(gpu::Device&) {}
  void execute(PassContext& context, const Params&, const Ports& ports) {
    context.device.clear(*ports.a, vec4(ports.data->value));
  }
};

class Broken : Counted {
 public:
  struct Params {};
  struct Ports {
    Out<Texture> a;
  };
  static void describe(PassInfo<Params, Ports>& d) {
    d.pass("Broken", "Its shader does not exist.");
    d.write("a", &Ports::a).texture(Format::R32Float);
  }
  explicit Broken(gpu::Device& device) { askForProgram(device); }
  void execute(PassContext&, const Params&, const Ports&) {}
  static void askForProgram(gpu::Device& device) {
    static_cast<void>(
        device.program({.vertex = "gpu/fullscreen.vert", .fragment = "no/such.frag"}));
  }
};

class BrokenLater : Counted {
 public:
  using Params = Broken::Params;
  using Ports = Broken::Ports;
  static void describe(PassInfo<Params, Ports>& d) {
    d.pass("BrokenLater", "Its shader does not exist, which shows when it draws.");
    d.write("a", &Ports::a).texture(Format::R32Float);
  }
  explicit BrokenLater(gpu::Device&) {}
  void execute(PassContext& context, const Params&, const Ports&) {
    Broken::askForProgram(context.device);
  }
};

}  // namespace lucerna::graph::sums
