// The templates of graph/pass_info.hpp; include that.
#pragma once

#include <cstdint>
#include <memory>

#include "graph/pass_info.hpp"

namespace lucerna::graph {

// The port type of typed data.
template <PortData T>
PortType dataPortType() {
  PortType type;
  type.data = typeid(T);
  type.dataName = T::kPortName;
  type.makeData = [] { return std::static_pointer_cast<void>(std::make_shared<T>()); };
  return type;
}

namespace detail {

template <typename T>
inline constexpr bool kIsVector =
    std::is_same_v<T, vec2> || std::is_same_v<T, vec3> || std::is_same_v<T, vec4>;

template <typename T>
PortType portTypeOf() {
  if constexpr (std::is_same_v<T, gpu::Texture>) {
    PortType type;
    type.texture = TextureSpec{};
    return type;
  } else {
    return dataPortType<T>();
  }
}

// Fills type, size and default value. An enum's default is its number until choices() names it.
template <typename Member>
void describeMember(ParamDescription& d, const Member& defaultValue) {
  if constexpr (std::is_same_v<Member, bool>) {
    d.type = ParamType::Bool;
    d.defaultValue = defaultValue;
  } else if constexpr (std::is_enum_v<Member>) {
    d.type = ParamType::Choice;
    d.defaultValue = static_cast<std::int64_t>(defaultValue);
  } else if constexpr (std::is_same_v<Member, int>) {
    d.type = ParamType::Int;
    d.defaultValue = static_cast<std::int64_t>(defaultValue);
  } else if constexpr (std::is_same_v<Member, float>) {
    d.type = ParamType::Float;
    d.defaultValue = decimalOf(defaultValue);
  } else if constexpr (std::is_same_v<Member, std::string>) {
    d.type = ParamType::Text;
    d.defaultValue = defaultValue;
  } else {
    static_assert(kIsVector<Member>, "a parameter is bool, int, float, text, enum or vec2 to vec4");
    d.type = ParamType::Vector;
    d.size = static_cast<std::size_t>(Member::length());
    std::vector<double> numbers;
    for (int i = 0; i < Member::length(); ++i) numbers.push_back(decimalOf(defaultValue[i]));
    d.defaultValue = std::move(numbers);
  }
}

// Values of a wrong type leave the member as it is: validation has reported them.
template <typename Member>
void assignMember(Member& member, const Value& value) {
  if constexpr (kIsVector<Member>) {
    const auto* numbers = std::get_if<std::vector<double>>(&value);
    if (!numbers || numbers->size() != static_cast<std::size_t>(Member::length())) return;
    for (int i = 0; i < Member::length(); ++i)
      member[i] = static_cast<float>((*numbers)[static_cast<std::size_t>(i)]);
  } else if constexpr (std::is_same_v<Member, float>) {
    if (const auto number = asNumber(value)) member = static_cast<float>(*number);
  } else if constexpr (std::is_same_v<Member, bool> || std::is_same_v<Member, std::string>) {
    if (const auto* same = std::get_if<Member>(&value)) member = *same;
  } else {  // int, enum
    if (const auto* number = std::get_if<std::int64_t>(&value))
      member = static_cast<Member>(*number);
  }
}

}  // namespace detail

template <typename Params, typename Ports>
void PassInfo<Params, Ports>::pass(std::string type, std::string summary) {
  description_.type = std::move(type);
  description_.summary = std::move(summary);
}

template <typename Params, typename Ports>
template <typename Member>
ParamBuilder PassInfo<Params, Ports>::param(std::string name, Member Params::* member) {
  ParamDescription& d = description_.params.emplace_back();
  d.name = std::move(name);
  detail::describeMember(d, Params{}.*member);
  setters_.push_back([member](Params& params, const Value& value) {
    detail::assignMember(params.*member, value);
  });
  return ParamBuilder(d);
}

template <typename Params, typename Ports>
template <typename T>
PortBuilder PassInfo<Params, Ports>::read(std::string name, In<T> Ports::* member) {
  return port<T>(std::move(name), Direction::In, member);
}

template <typename Params, typename Ports>
template <typename T>
PortBuilder PassInfo<Params, Ports>::write(std::string name, Out<T> Ports::* member) {
  return port<T>(std::move(name), Direction::Out, member);
}

template <typename Params, typename Ports>
template <typename T>
PortBuilder PassInfo<Params, Ports>::update(std::string name, InOut<T> Ports::* member) {
  return port<T>(std::move(name), Direction::InOut, member);
}

template <typename Params, typename Ports>
template <typename T, typename Member>
PortBuilder PassInfo<Params, Ports>::port(std::string name, Direction direction, Member member) {
  PortDescription& d = description_.ports.emplace_back();
  d.name = std::move(name);
  d.direction = direction;
  d.type = detail::portTypeOf<T>();
  binders_.push_back([member](Ports& ports, const BoundPort& bound) {
    T* pointer = nullptr;
    if constexpr (std::is_same_v<T, gpu::Texture>)
      pointer = bound.texture;
    else
      pointer = static_cast<T*>(bound.data);
    if constexpr (std::is_same_v<Member, InOut<T> Ports::*>)
      (ports.*member).bind(pointer, bound.isNew);
    else
      (ports.*member).bind(pointer);
  });
  return PortBuilder(d);
}

template <typename Params, typename Ports>
void PassInfo<Params, Ports>::assign(Params& params, const ParamValues& values) const {
  for (std::size_t i = 0; i < setters_.size(); ++i) {
    const ParamDescription& d = description_.params[i];
    if (const auto value = values.find(d.name); value != values.end()) {
      setters_[i](params, value->second);
      if (const auto index = choiceIndex(d, value->second)) setters_[i](params, Value(*index));
    }
  }
}

template <typename Params, typename Ports>
void PassInfo<Params, Ports>::bind(Ports& ports, std::span<const BoundPort> bound) const {
  CHECK(bound.size() == binders_.size(), "{}: {} ports bound, {} declared", description_.type,
        bound.size(), binders_.size());
  for (std::size_t i = 0; i < bound.size(); ++i) binders_[i](ports, bound[i]);
}

namespace detail {

// The pass's own declaration for the given values: its parameters may depend on nothing, its ports
// and sizes on the parameters.
template <typename Pass>
PassInfo<typename Pass::Params, typename Pass::Ports> passInfoFor(const ParamValues& values) {
  using Info = PassInfo<typename Pass::Params, typename Pass::Ports>;
  typename Pass::Params params{};
  Info defaults(params);
  Pass::describe(defaults);
  defaults.assign(params, values);
  Info info(params);
  Pass::describe(info);
  return info;
}

template <typename Pass>
class TypedInstance final : public PassInstance {
 public:
  explicit TypedInstance(gpu::Device& device)
      : pass_(device), info_(passInfoFor<Pass>(ParamValues{})) {}

  void setParams(const ParamValues& values) override {
    info_ = passInfoFor<Pass>(values);
    params_ = info_.values();
  }
  void execute(PassContext& context, std::span<const BoundPort> bound) override {
    typename Pass::Ports ports;  // new, for parameters may have taken some away
    info_.bind(ports, bound);
    pass_.execute(context, params_, ports);
  }

 private:
  Pass pass_;
  PassInfo<typename Pass::Params, typename Pass::Ports> info_;
  typename Pass::Params params_{};
};

template <typename Pass>
class TypedPassType final : public PassType {
 public:
  PassDescription describe(const ParamValues& values) const override {
    return passInfoFor<Pass>(values).description();
  }
  std::unique_ptr<PassInstance> create(gpu::Device& device) const override {
    return std::make_unique<TypedInstance<Pass>>(device);
  }
};

}  // namespace detail

template <typename Pass>
std::unique_ptr<PassType> makePassType() {
  return std::make_unique<detail::TypedPassType<Pass>>();
}

}  // namespace lucerna::graph
