#include "trace/reflectance.hpp"

#include <algorithm>
#include <cmath>

namespace lucerna::trace {
namespace {

constexpr float kLowestRoughness = 0.045f;

vec3 phong(const SurfacePoint& p, vec3 toLightW, float cosLight) {
  const vec3 mirroredW = 2.f * cosLight * p.normalW - toLightW;
  const float along = glm::dot(mirroredW, p.toEyeW);
  const float highlight = along > 0.f ? std::pow(along, p.shininess) : 0.f;
  return (p.albedo * cosLight + p.specular * highlight) / kPi;
}

// Trowbridge and Reitz 1975; written for the angle between n and h by its sine, which keeps its
// digits where the highlight is.
float distribution(float cosHalf, float sineSquared, float alpha) {
  const float a2 = alpha * alpha;
  const float base = cosHalf * cosHalf * a2 + sineSquared;
  return a2 / (kPi * base * base);
}

// Heitz, JCGT 3(2), 2014: height-correlated masking and shadowing over 4 (n.l) (n.v).
float maskingShadowing(float cosLight, float cosEye, float alpha) {
  const float a2 = alpha * alpha;
  const auto lambda = [&](float c) { return std::sqrt(a2 + (1.f - a2) * c * c); };
  return 0.5f / (cosLight * lambda(cosEye) + cosEye * lambda(cosLight));
}

vec3 microfacets(const SurfacePoint& p, vec3 toLightW, float cosLight) {
  const bool metallicModel = p.material->model != scene::MaterialModel::SpecularGlossiness;
  const float metallic = metallicModel ? p.metallic : 0.f;
  const float rough = std::max(p.roughness, kLowestRoughness);
  const vec3 halfway = glm::normalize(toLightW + p.toEyeW);
  const float cosEye = std::max(glm::dot(p.normalW, p.toEyeW), 1e-4f);
  const float cosHalf = std::clamp(glm::dot(p.normalW, halfway), 0.f, 1.f);
  const vec3 sine = glm::cross(p.normalW, halfway);
  const vec3 f0 = metallicModel ? glm::mix(vec3(0.04f), p.albedo, metallic) : p.specular;
  const float away = 1.f - std::clamp(glm::dot(p.toEyeW, halfway), 0.f, 1.f);
  const vec3 fresnel = f0 + (1.f - f0) * std::pow(away, 5.f);
  const vec3 diffuse = (1.f - fresnel) * (1.f - metallic) * p.albedo / kPi;
  const vec3 specular = fresnel * distribution(cosHalf, glm::dot(sine, sine), rough * rough) *
                        maskingShadowing(cosLight, cosEye, rough * rough);
  return (diffuse + specular) * cosLight;
}

}  // namespace

vec3 reflected(const SurfacePoint& point, vec3 toLightW) {
  const float cosLight = glm::dot(point.normalW, toLightW);
  if (point.unlit || cosLight <= 0.f) return vec3(0.f);
  return point.material->model == scene::MaterialModel::Phong
             ? phong(point, toLightW, cosLight)
             : microfacets(point, toLightW, cosLight);
}

vec3 diffuseAlbedo(const SurfacePoint& point) {
  if (point.unlit) return vec3(0.f);
  const bool metals = point.material->model == scene::MaterialModel::MetallicRoughness;
  return point.albedo * (metals ? 1.f - point.metallic : 1.f);
}

vec3 ambientAlbedo(const SurfacePoint& point) {
  if (point.unlit) return vec3(0.f);
  return point.material->model == scene::MaterialModel::SpecularGlossiness
             ? point.albedo + point.specular
             : point.albedo;
}

}  // namespace lucerna::trace
