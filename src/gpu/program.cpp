#include "gpu/program.hpp"

#include <algorithm>
#include <set>

#include "core/text.hpp"
#include "gpu/device_impl.hpp"

namespace lucerna::gpu {
namespace {

std::string describe(const ProgramDesc& desc) {
  std::vector<std::string> words;
  for (const std::string* path : {&desc.vertex, &desc.fragment, &desc.compute})
    if (!path->empty()) words.push_back(*path);
  std::string text = join(words, " + ");
  if (desc.defines.empty()) return text + ", no defines";
  text += ", defines";
  for (const auto& [name, value] : desc.defines)
    text += value.empty() ? " " + name : fmt::format(" {}={}", name, value);
  return text;
}

template <typename GetLength, typename GetLog>
std::string infoLog(GLuint object, GetLength getLength, GetLog getLog) {
  GLint length = 0;
  getLength(object, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
  getLog(object, static_cast<GLsizei>(log.size()), nullptr, log.data());
  log.resize(log.find('\0') == std::string::npos ? log.size() : log.find('\0'));
  return log;
}

// A shader object; or the driver's log with files and lines of ours.
Result<GLuint> compile(GLenum stage, const ExpandedShader& source, const ProgramDesc& desc) {
  const GLuint shader = glCreateShader(stage);
  const char* text = source.text.c_str();
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  GLint compiled = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  if (compiled) return shader;
  const std::string log = infoLog(shader, glGetShaderiv, glGetShaderInfoLog);
  glDeleteShader(shader);
  return error(ErrorKind::Pipeline, "{}\n(compiling {})", mapShaderLog(log, source),
               describe(desc));
}

// A linked program. Adds every file that was read to `files`, also on failure.
Result<GLuint> build(ShaderSources& sources, const ProgramDesc& desc,
                     std::set<std::string>& files) {
  const std::pair<GLenum, const std::string*> stages[] = {{GL_VERTEX_SHADER, &desc.vertex},
                                                          {GL_FRAGMENT_SHADER, &desc.fragment},
                                                          {GL_COMPUTE_SHADER, &desc.compute}};
  const GLuint program = glCreateProgram();
  const auto failed = [&](Error error) {
    glDeleteProgram(program);  // its shaders are marked for deletion and go with it
    return error;
  };
  for (const auto& [stage, path] : stages) {
    if (path->empty()) continue;
    files.insert(*path);
    Result<ExpandedShader> source = sources.expand(*path, desc.defines);
    if (!source) return failed(source.error());
    files.insert(source->files.begin(), source->files.end());
    Result<GLuint> shader = compile(stage, *source, desc);
    if (!shader) return failed(shader.error());
    glAttachShader(program, *shader);
    glDeleteShader(*shader);
  }
  glLinkProgram(program);
  GLint linked = 0;
  glGetProgramiv(program, GL_LINK_STATUS, &linked);
  if (linked) return program;
  return failed(error(
      ErrorKind::Pipeline, "{}: error: does not link: {}",
      desc.compute.empty() ? desc.fragment : desc.compute,
      infoLog(program, glGetProgramiv, glGetProgramInfoLog) + "(linking " + describe(desc) + ")"));
}

GLint count(GLuint program, GLenum interface) {
  GLint result = 0;
  glGetProgramInterfaceiv(program, interface, GL_ACTIVE_RESOURCES, &result);
  return result;
}

std::string name(GLuint program, GLenum interface, GLuint index) {
  const GLenum property = GL_NAME_LENGTH;
  GLint length = 0;
  glGetProgramResourceiv(program, interface, index, 1, &property, 1, nullptr, &length);
  std::string result(static_cast<std::size_t>(length), '\0');
  glGetProgramResourceName(program, interface, index, length, nullptr, result.data());
  result.resize(static_cast<std::size_t>(std::max(length - 1, 0)));
  return result;
}

enum class Opaque { No, Sampler, Image };

struct Type {
  GLenum type;
  const char* name;  // in GLSL
  Opaque opaque = Opaque::No;
};
constexpr Type kTypes[] = {
    {GL_FLOAT, "float"},
    {GL_FLOAT_VEC2, "vec2"},
    {GL_FLOAT_VEC3, "vec3"},
    {GL_FLOAT_VEC4, "vec4"},
    {GL_INT, "int"},
    {GL_BOOL, "bool"},
    {GL_SAMPLER_2D, "sampler2D", Opaque::Sampler},
    {GL_SAMPLER_2D_SHADOW, "sampler2DShadow", Opaque::Sampler},
    {GL_SAMPLER_2D_ARRAY, "sampler2DArray", Opaque::Sampler},
    {GL_SAMPLER_2D_ARRAY_SHADOW, "sampler2DArrayShadow", Opaque::Sampler},
    {GL_SAMPLER_CUBE, "samplerCube", Opaque::Sampler},
    {GL_SAMPLER_CUBE_SHADOW, "samplerCubeShadow", Opaque::Sampler},
    {GL_SAMPLER_CUBE_MAP_ARRAY, "samplerCubeArray", Opaque::Sampler},
    {GL_SAMPLER_CUBE_MAP_ARRAY_SHADOW, "samplerCubeArrayShadow", Opaque::Sampler},
    {GL_SAMPLER_2D_MULTISAMPLE, "sampler2DMS", Opaque::Sampler},
    {GL_INT_SAMPLER_2D, "isampler2D", Opaque::Sampler},
    {GL_INT_SAMPLER_2D_ARRAY, "isampler2DArray", Opaque::Sampler},
    {GL_INT_SAMPLER_CUBE, "isamplerCube", Opaque::Sampler},
    {GL_INT_SAMPLER_2D_MULTISAMPLE, "isampler2DMS", Opaque::Sampler},
    {GL_UNSIGNED_INT_SAMPLER_2D, "usampler2D", Opaque::Sampler},
    {GL_UNSIGNED_INT_SAMPLER_2D_ARRAY, "usampler2DArray", Opaque::Sampler},
    {GL_UNSIGNED_INT_SAMPLER_CUBE, "usamplerCube", Opaque::Sampler},
    {GL_UNSIGNED_INT_SAMPLER_CUBE_MAP_ARRAY, "usamplerCubeArray", Opaque::Sampler},
    {GL_UNSIGNED_INT_SAMPLER_2D_MULTISAMPLE, "usampler2DMS", Opaque::Sampler},
    {GL_IMAGE_2D, "image2D", Opaque::Image},
    {GL_IMAGE_2D_ARRAY, "image2DArray", Opaque::Image},
    {GL_IMAGE_CUBE, "imageCube", Opaque::Image},
    {GL_INT_IMAGE_2D, "iimage2D", Opaque::Image},
    {GL_INT_IMAGE_2D_ARRAY, "iimage2DArray", Opaque::Image},
    {GL_UNSIGNED_INT_IMAGE_2D, "uimage2D", Opaque::Image},
    {GL_UNSIGNED_INT_IMAGE_2D_ARRAY, "uimage2DArray", Opaque::Image},
    {GL_UNSIGNED_INT_IMAGE_CUBE, "uimageCube", Opaque::Image},
};

const Type& typeOf(GLenum type) {
  static constexpr Type kOther{GL_NONE, "other"};
  const auto* const known = std::ranges::find(kTypes, type, &Type::type);
  return known == std::end(kTypes) ? kOther : *known;
}

// Of one float or vector; 0 for all else.
int floatsOf(const Uniform& uniform) {
  if (uniform.count != 1) return 0;
  switch (uniform.type) {
    case GL_FLOAT:
      return 1;
    case GL_FLOAT_VEC2:
      return 2;
    case GL_FLOAT_VEC3:
      return 3;
    case GL_FLOAT_VEC4:
      return 4;
    default:
      return 0;
  }
}

}  // namespace

// Reads what the program uses and gives samplers, images and blocks their binding points.
struct Reflector {
  GLuint program;
  Program::Reflection& result;

  void uniforms() {
    for (GLint i = 0; i < count(program, GL_UNIFORM); ++i) {
      const auto index = static_cast<GLuint>(i);
      const GLenum properties[] = {GL_LOCATION, GL_TYPE, GL_ARRAY_SIZE};
      GLint values[3] = {};
      glGetProgramResourceiv(program, GL_UNIFORM, index, 3, properties, 3, nullptr, values);
      if (values[0] < 0) continue;  // a member of a block
      std::string key = name(program, GL_UNIFORM, index);
      const bool array = key.ends_with("[0]");
      if (array) key.resize(key.size() - 3);
      Uniform uniform{values[0], static_cast<GLenum>(values[1]), values[2]};
      if (floatsOf(uniform) > 0) glGetUniformfv(program, uniform.location, uniform.initial.data());
      switch (typeOf(uniform.type).opaque) {
        case Opaque::No:
          result.uniforms[key] = uniform;
          break;
        case Opaque::Sampler:
          slots(result.samplers, key, array, uniform);
          break;
        case Opaque::Image:
          slots(result.images, key, array, uniform);
          break;
      }
    }
  }

  void blocks() {
    for (const GLenum interface : {GL_UNIFORM_BLOCK, GL_SHADER_STORAGE_BLOCK}) {
      const bool storage = interface == GL_SHADER_STORAGE_BLOCK;
      auto& list = storage ? result.storageBlocks : result.uniformBlocks;
      for (GLint i = 0; i < count(program, interface); ++i) {
        const auto index = static_cast<GLuint>(i);
        const GLenum property = GL_BUFFER_DATA_SIZE;
        GLint bytes = 0;
        glGetProgramResourceiv(program, interface, index, 1, &property, 1, nullptr, &bytes);
        list.push_back({name(program, interface, index), index, bytes, 0});
        if (storage)
          glShaderStorageBlockBinding(program, index, index);
        else
          glUniformBlockBinding(program, index, index);
      }
    }
  }

  void inputs() {
    for (const auto& [name, uniform] : result.uniforms)
      result.inputs.push_back({name, uniform.count == 1 ? typeOf(uniform.type).name : "other"});
    for (const auto* slots : {&result.samplers, &result.images})
      for (const auto& slot : *slots) result.inputs.push_back({slot.name, typeOf(slot.type).name});
    for (const auto* blocks : {&result.uniformBlocks, &result.storageBlocks})
      for (const auto& block : *blocks) result.inputs.push_back({block.name, "block"});
  }

 private:
  void slots(std::vector<Program::Reflection::Slot>& list, const std::string& key, bool array,
             const Uniform& uniform) {
    for (GLint element = 0; element < uniform.count; ++element) {
      const auto unit = static_cast<GLuint>(list.size());
      list.push_back({array ? fmt::format("{}[{}]", key, element) : key, unit, 0, uniform.type});
      glProgramUniform1i(program, uniform.location + element, static_cast<GLint>(unit));
    }
  }
};

Program::Program() : reflection_(std::make_unique<Reflection>()) {}

Program::~Program() {
  if (id_ == 0) return;
  glDeleteProgram(id_);
  --device_->impl().objects.programs;
}

const std::vector<ProgramInput>& Program::inputs() const {
  return reflection_->inputs;
}

bool Program::includes(std::string_view file) const {
  return std::ranges::find(reflection_->files, file) != reflection_->files.end();
}

void Program::reset() const {
  for (const auto& [name, uniform] : reflection_->uniforms)
    switch (const GLfloat* values = uniform.initial.data(); floatsOf(uniform)) {
      case 1:
        glProgramUniform1fv(id_, uniform.location, 1, values);
        break;
      case 2:
        glProgramUniform2fv(id_, uniform.location, 1, values);
        break;
      case 3:
        glProgramUniform3fv(id_, uniform.location, 1, values);
        break;
      case 4:
        glProgramUniform4fv(id_, uniform.location, 1, values);
        break;
      default:
        break;
    }
}

const Uniform* Program::find(std::string_view name) const {
  const auto found = reflection_->uniforms.find(name);
  return found == reflection_->uniforms.end() ? nullptr : &found->second;
}

namespace {

void checkType(const Uniform& uniform, std::string_view name, std::initializer_list<GLenum> types,
               std::size_t values = 1) {
  CHECK(std::find(types.begin(), types.end(), uniform.type) != types.end(),
        "uniform '{}' has another type than the value given (GL type 0x{:x})", name, uniform.type);
  CHECK(static_cast<GLint>(values) <= uniform.count, "uniform '{}' has {} elements, given {}", name,
        uniform.count, values);
}

}  // namespace

void Program::set(std::string_view name, float value) const {
  set(name, std::span<const float>(&value, 1));
}
void Program::set(std::string_view name, int value) const {
  const Uniform* uniform = find(name);
  if (!uniform) return;
  checkType(*uniform, name, {GL_INT, GL_BOOL});
  glProgramUniform1i(id_, uniform->location, value);
}
void Program::setBool(std::string_view name, bool value) const {
  const Uniform* uniform = find(name);
  if (!uniform) return;
  checkType(*uniform, name, {GL_BOOL, GL_INT});
  glProgramUniform1i(id_, uniform->location, value ? 1 : 0);
}
void Program::set(std::string_view name, std::uint32_t value) const {
  const Uniform* uniform = find(name);
  if (!uniform) return;
  checkType(*uniform, name, {GL_UNSIGNED_INT});
  glProgramUniform1ui(id_, uniform->location, value);
}
void Program::set(std::string_view name, vec2 value) const {
  const Uniform* uniform = find(name);
  if (!uniform) return;
  checkType(*uniform, name, {GL_FLOAT_VEC2});
  glProgramUniform2fv(id_, uniform->location, 1, &value.x);
}
void Program::set(std::string_view name, vec3 value) const {
  set(name, std::span<const vec3>(&value, 1));
}
void Program::set(std::string_view name, vec4 value) const {
  set(name, std::span<const vec4>(&value, 1));
}
void Program::set(std::string_view name, ivec2 value) const {
  const Uniform* uniform = find(name);
  if (!uniform) return;
  checkType(*uniform, name, {GL_INT_VEC2});
  glProgramUniform2iv(id_, uniform->location, 1, &value.x);
}
void Program::set(std::string_view name, const mat3& value) const {
  const Uniform* uniform = find(name);
  if (!uniform) return;
  checkType(*uniform, name, {GL_FLOAT_MAT3});
  glProgramUniformMatrix3fv(id_, uniform->location, 1, GL_FALSE, &value[0].x);
}
void Program::set(std::string_view name, const mat4& value) const {
  const Uniform* uniform = find(name);
  if (!uniform) return;
  checkType(*uniform, name, {GL_FLOAT_MAT4});
  glProgramUniformMatrix4fv(id_, uniform->location, 1, GL_FALSE, &value[0].x);
}
void Program::set(std::string_view name, std::span<const float> values) const {
  const Uniform* uniform = find(name);
  if (!uniform || values.empty()) return;
  checkType(*uniform, name, {GL_FLOAT}, values.size());
  glProgramUniform1fv(id_, uniform->location, static_cast<GLsizei>(values.size()), values.data());
}
void Program::set(std::string_view name, std::span<const vec3> values) const {
  const Uniform* uniform = find(name);
  if (!uniform || values.empty()) return;
  checkType(*uniform, name, {GL_FLOAT_VEC3}, values.size());
  glProgramUniform3fv(id_, uniform->location, static_cast<GLsizei>(values.size()), &values[0].x);
}
void Program::set(std::string_view name, std::span<const vec4> values) const {
  const Uniform* uniform = find(name);
  if (!uniform || values.empty()) return;
  checkType(*uniform, name, {GL_FLOAT_VEC4}, values.size());
  glProgramUniform4fv(id_, uniform->location, static_cast<GLsizei>(values.size()), &values[0].x);
}

// A linked program takes the place of what was there.
void Device::take(Program& program, std::uint32_t linked) {
  if (program.id_ == 0) ++impl_->objects.programs;
  glDeleteProgram(program.id_);
  if (impl_->boundProgram == program.id_) impl_->boundProgram = 0;
  program.id_ = linked;
  impl_->setLabel(GL_PROGRAM, program.id_, describe(program.desc_));
  std::vector<std::string> files = std::move(program.reflection_->files);
  *program.reflection_ = {};
  program.reflection_->files = std::move(files);
  Reflector reflector{program.id_, *program.reflection_};
  reflector.uniforms();
  reflector.blocks();
  reflector.inputs();
}

Result<std::uint32_t> Device::link(Program& program) {
  std::set<std::string> files;
  Result<std::uint32_t> linked = build(*impl_->sources, program.desc_, files);
  program.reflection_->files.assign(files.begin(), files.end());
  if (!linked && !program.usable()) {
    impl_->errors.push_back(linked.error());
    program.reflection_->fault = linked.error();
  }
  return linked;
}

ProgramPtr Device::program(const ProgramDesc& desc) {
  CHECK(desc.compute.empty() ? !desc.vertex.empty() && !desc.fragment.empty()
                             : desc.vertex.empty() && desc.fragment.empty(),
        "a program is vertex + fragment, or compute: {}", describe(desc));
  std::shared_ptr<Program>& entry = impl_->programs[desc];
  if (!entry) {
    entry.reset(new Program());
    entry->desc_ = desc;
    entry->device_ = this;
    if (const auto linked = link(*entry)) take(*entry, *linked);
  } else if (const auto& fault = entry->reflection_->fault) {
    reportError(*fault);  // who asks for it only now must hear of it too
  }
  return entry;
}

Result<int> Device::reloadShaders(std::span<const std::string> changed) {
  if (changed.empty()) return 0;
  std::vector<std::pair<Program*, std::uint32_t>> linked;
  std::vector<std::string> faults;
  for (auto& [desc, program] : impl_->programs) {
    const std::vector<std::string>& files = program->reflection_->files;
    // What never compiled may wait for a file that it could not even name.
    const bool concerned =
        !program->usable() || std::ranges::any_of(changed, [&](const std::string& file) {
          return std::ranges::binary_search(files, file);
        });
    if (!concerned) continue;
    if (const auto id = link(*program))
      linked.emplace_back(program.get(), *id);
    else if (program->usable())
      faults.push_back(id.error().message);
  }
  for (const auto& [program, id] : linked)
    if (faults.empty())
      take(*program, id);
    else
      glDeleteProgram(id);
  if (!faults.empty()) return error(ErrorKind::Pipeline, "{}", join(faults, "\n"));
  return static_cast<int>(linked.size());
}

}  // namespace lucerna::gpu
