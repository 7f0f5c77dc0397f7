// This file tests the compact form: its results, and how its numbers are found.
#include "lower/form_fit.hpp"

#include <cmath>

#include <catch2/catch.hpp>

#include "lower/interpreter.hpp"

using namespace remap;

namespace {

constexpr Domain kDomain{{0.01, 1.0}, {0.0, 1.0}};

CompactForm free_form() {
  CompactForm form;
  form.pole = 0.3f;
  form.alpha = {{1.1f, -0.2f}, {0.05f}};
  form.specular = {{0.9f, -0.3f}, {0.2f}};
  return form;
}

CompactForm limited_form() {
  CompactForm form = free_form();
  form.alpha = {{1.3f, -0.1f}, {0.05f}};
  form.specular = {{1.8f, -0.3f}, {0.2f}};
  form.alpha_limit = 1.0f;
  form.specular_limit = 1.0f;
  form.hinge = {-0.3f, 0.1f, 0.2f, 0.4f};
  return form;
}

std::vector<FormSample> samples_of(const CompactForm& form) {
  std::vector<FormSample> samples;
  for (int i = 0; i <= 20; ++i)
    for (int j = 1; j <= 10; ++j) {
      const MappedTexel source{0.01 + 0.99 * i / 20.0, j / 10.0};
      const MappedTexel target = form_texel(form, kDomain, source.alpha, source.specular);
      samples.push_back({source, target, form.alpha_limit && target.alpha >= 1.0,
                         form.specular_limit && target.specular >= 1.0});
    }
  return samples;
}

double largest_difference(const CompactForm& form, const std::vector<FormSample>& samples) {
  double largest = 0.0;
  for (const FormSample& sample : samples) {
    const MappedTexel found = form_texel(form, kDomain, sample.source.alpha, sample.source.specular);
    largest = std::max({largest, std::fabs(found.alpha - sample.target.alpha),
                        std::fabs(found.specular - sample.target.specular)});
  }
  return largest;
}

}  // namespace

TEST_CASE("compact form: beyond the domain both parameters go on in proportion, and 0 stays 0") {
  const CompactForm form = free_form();
  const MappedTexel edge = form_texel(form, kDomain, 0.01, 0.5);
  CHECK(form_texel(form, kDomain, 0.001, 0.5).alpha == Approx(0.1 * edge.alpha));
  CHECK(form_texel(form, kDomain, 0.001, 0.5).specular == Approx(edge.specular));
  CHECK(form_texel(form, kDomain, 0.0, 0.0).alpha == 0.0);
  CHECK(form_texel(form, kDomain, 0.3, 0.0).specular == 0.0);
  const MappedTexel bright = form_texel(form, kDomain, 0.3, 1.0);
  CHECK(form_texel(form, kDomain, 0.3, 5.0).specular == Approx(5.0 * bright.specular));
  CHECK(form_texel(form, kDomain, 0.3, 5.0).alpha == Approx(bright.alpha));
}

TEST_CASE("compact form: at a limit the other parameter turns, without a step") {
  const CompactForm form = limited_form();
  double before = 0.0;
  for (int i = 1; i <= 2000; ++i) {
    const MappedTexel texel = form_texel(form, kDomain, 0.4, i / 2000.0);
    CHECK(texel.specular <= 1.0);
    if (i > 1) CHECK(std::fabs(texel.alpha - before) < 1e-3);
    before = texel.alpha;
  }
  CHECK(form_texel(form, kDomain, 0.4, 1.0).alpha < form_texel(form, kDomain, 0.4, 0.5).alpha);
  CHECK(form_texel(form, kDomain, 1.0, 0.3).alpha == 1.0);
}

TEST_CASE("form fit: the form that samples were made of is found") {
  const std::vector<FormSample> samples = samples_of(free_form());
  const CompactForm found = fit_form(samples, {}, kDomain, {2, 2});
  CHECK(largest_difference(found, samples) < 1e-4);
  CHECK(is_sound(found, kDomain));
}

TEST_CASE("form fit: the hinge is found where a limit binds") {
  const std::vector<FormSample> samples = samples_of(limited_form());
  const CompactForm found = fit_form(samples, {1.0, 1.0}, kDomain, {2, 2});
  CHECK(found.alpha_limit == 1.0f);
  CHECK(found.specular_limit == 1.0f);
  CHECK(largest_difference(found, samples) < 5e-3);
}

TEST_CASE("form fit: rows that do not determine the numbers are refused") {
  std::vector<FormSample> samples = samples_of(free_form());
  samples.resize(4);
  CHECK_THROWS_WITH(fit_form(samples, {}, kDomain, {3, 4}), Catch::Contains("do not determine 9 numbers"));
}

TEST_CASE("form fit: numbers go there and back, and the count leaves out what is not used") {
  const CompactForm form = limited_form();
  CHECK(with_numbers(form, numbers_of(form)).hinge == form.hinge);
  CHECK(number_count(form) == 11);
  CHECK(number_count(free_form()) == 7);
  CompactForm line;
  line.alpha = {{0.9f}};
  CHECK(number_count(line) == 2);
  CHECK_FALSE(is_copy(line));
  CHECK(is_copy(CompactForm{}));
  CHECK(number_count(CompactForm{}) == 0);
}
