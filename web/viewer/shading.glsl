// This file shades one material for the viewer, under a map of light in latitude and longitude. Light directions are a
// mixture of visible GGX normals (Dupuy and Benyoub 2023) and of a cosine lobe, weighted by the balance heuristic
// (Veach and Guibas 1995). Each reads the light averaged over its solid angle (Krivanek and Colbert 2008). The viewer
// averages many frames. SHAPE is the name of a lobe of brdf.glsl, whose text comes before this one.
uniform sampler2D roughness_map, specular_map, diffuse_map, normal_map, light_map, previous;
// These are the size of the canvas in pixels, the place of its middle on the picture, and a shift within the pixel.
uniform vec2 size, center, jitter;
uniform float zoom, turn, specular_range, light_range, light_height;
uniform bool has_schlick, has_diffuse, has_normals, is_shader_ball;
uniform int sample_count, frame, frame_count;  // sample_count: samples per pixel in each frame
out vec4 mean;

const float kCameraDistance = 3.0, kHalfImage = 0.35355339;  // of the scene of remapc (look/scene.hpp)
const float kPi = 3.14159265358979;

// Returns a PCG hash (Jarzynski and Olano 2020).
uvec2 hashed(uvec2 v) {
  v = v * 1664525u + 1013904223u;
  v.x += v.y * 1664525u;
  v.y += v.x * 1664525u;
  v ^= v >> 16u;
  v.x += v.y * 1664525u;
  v.y += v.x * 1664525u;
  return v ^ (v >> 16u);
}

// Returns the distance to the shader ball: a ball with a groove, on a foot.
float distance_to_shader_ball(vec3 p) {
  vec3 q = p - vec3(0.0, 0.16, 0.0);
  float ball = length(q) - 0.72;
  float groove = length(vec2(length(q.xz) - 0.72, q.y + 0.22)) - 0.045;
  ball = max(ball, -groove);
  float foot = max(length(p.xz) - 0.46 - 0.1 * smoothstep(-0.62, -0.9, p.y), max(p.y + 0.56, -0.9 - p.y));
  float edge = clamp(0.5 + 0.5 * (foot - ball) / 0.06, 0.0, 1.0);
  return mix(foot, ball, edge) - 0.06 * edge * (1.0 - edge);
}

bool hit_shader_ball(vec3 origin, vec3 ray, out vec3 position, out vec3 normal) {
  float t = kCameraDistance - 1.1;
  for (int i = 0; i < 96 && t < kCameraDistance + 1.1; ++i) {
    position = origin + t * ray;
    float step_length = distance_to_shader_ball(position);
    if (step_length < 0.0005) {
      vec2 e = vec2(0.001, 0.0);
      normal = normalize(vec3(distance_to_shader_ball(position + e.xyy) - distance_to_shader_ball(position - e.xyy),
                              distance_to_shader_ball(position + e.yxy) - distance_to_shader_ball(position - e.yxy),
                              distance_to_shader_ball(position + e.yyx) - distance_to_shader_ball(position - e.yyx)));
      return true;
    }
    t += 0.8 * step_length;
  }
  return false;
}

bool hit_ball(vec3 origin, vec3 ray, out vec3 position) {
  float along = dot(origin, ray), root = along * along - dot(origin, origin) + 1.0;
  if (root < 0.0) return false;
  position = normalize(origin - (along + sqrt(root)) * ray);
  return true;
}

mat3 frame_about(vec3 n) {
  vec3 side = abs(n.y) < 0.99 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0);
  vec3 tangent = normalize(cross(side, n));
  return mat3(tangent, cross(n, tangent), n);
}

vec3 light_from(vec3 w, float solid_angle) {
  float c = cos(turn), s = sin(turn);
  w = vec3(c * w.x - s * w.z, w.y, s * w.x + c * w.z);
  vec2 place = vec2(0.5 + atan(w.x, -w.z) / (2.0 * kPi), acos(clamp(w.y, -1.0, 1.0)) / kPi);
  float texel = kPi / light_height;
  return light_range * textureLod(light_map, place, max(0.0, 0.5 * log2(solid_angle / (texel * texel)))).rgb;
}

vec3 shaded(vec3 n, vec3 view, float alpha, vec3 specular, vec3 diffuse, vec2 shift) {
  mat3 axes = frame_about(n);
  float cos_view = max(dot(n, view), 0.001);
  vec3 stretched = normalize(vec3(alpha, alpha, 1.0) * (view * axes));
  float half_count = 0.5 * float(sample_count);
  vec3 sum = vec3(0.0);
  for (int i = 0; i < sample_count; ++i) {
    float k = float(frame * sample_count + i);
    vec2 u = fract(shift + k * vec2(0.7548776662, 0.5698402910));  // Roberts 2018
    float azimuth = 2.0 * kPi * u.y;
    vec3 light;
    if (i % 2 == 0) {
      float z = (1.0 - u.x) * (1.0 + stretched.z) - stretched.z;
      float sine = sqrt(max(0.0, 1.0 - z * z));
      vec3 h = normalize(vec3(alpha, alpha, 1.0) * (vec3(sine * cos(azimuth), sine * sin(azimuth), z) + stretched));
      h = axes * h;
      light = 2.0 * dot(view, h) * h - view;
    } else {
      float sine = sqrt(u.x);
      light = axes * vec3(sine * cos(azimuth), sine * sin(azimuth), sqrt(1.0 - u.x));
    }
    float cos_light = dot(n, light), cos_between = dot(light, view);
    if (cos_light <= 0.0 || 1.0 + cos_between <= 0.0) continue;
    LocalGeometry g;
    g.cos_light = cos_light;
    g.cos_view = cos_view;
    g.half_length_2 = 2.0 + 2.0 * cos_between;
    g.cos_half = min(1.0, (cos_light + cos_view) / sqrt(g.half_length_2));
    g.cos_light_half = min(1.0, 0.5 * sqrt(g.half_length_2));
    g.cos_mirror = min(1.0, 2.0 * cos_light * cos_view - cos_between);
    float density = half_count * (ggx_distribution(alpha, g.cos_half) * ggx_shadowing(alpha, cos_view) / (4.0 * cos_view) +
                                  cos_light / kPi);
    vec3 fresnel = has_schlick ? mix(specular, vec3(1.0), schlick_weight(g.cos_light_half)) : specular;
    vec3 reflected = (SHAPE(alpha, g) * fresnel + diffuse / kPi) * cos_light;
    sum += light_from(light, 1.0 / (density * float(frame_count))) * reflected / density;
  }
  return sum;
}

void main() {
  vec2 at = (gl_FragCoord.xy + jitter - 0.5 * size) / (0.5 * min(size.x, size.y)) / zoom + center;
  vec3 origin = vec3(0.0, 0.0, kCameraDistance), ray = normalize(vec3(at * kHalfImage, -1.0)), position, normal;
  bool is_hit = is_shader_ball ? hit_shader_ball(origin, ray, position, normal) : hit_ball(origin, ray, position);
  vec4 now = vec4(0.0);
  if (is_hit) {
    vec3 place = normalize(position);
    if (!is_shader_ball) normal = place;
    // The half that the camera sees has the whole map.
    vec2 uv = vec2(0.5 + atan(place.x, place.z) / kPi, acos(clamp(place.y, -1.0, 1.0)) / kPi);
    float alpha = texture(roughness_map, uv).r;
    alpha = max(alpha * alpha, 0.01);
    vec3 specular = specular_range * texture(specular_map, uv).rgb;
    vec3 diffuse = has_diffuse ? texture(diffuse_map, uv).rgb : vec3(0.0);
    vec3 view = normalize(origin - position);
    if (has_normals) {
      vec3 tangent = normalize(vec3(normal.z, 0.0, -normal.x) + vec3(0.0001, 0.0, 0.0));
      vec3 bent = 2.0 * texture(normal_map, uv).rgb - 1.0;
      normal = normalize(bent.x * tangent + bent.y * cross(normal, tangent) + max(bent.z, 0.05) * normal);
      // A normal that the camera would see from behind is turned until it faces the camera (look/lit_sphere.cpp).
      normal = normalize(normal + max(0.05 - dot(normal, view), 0.0) * view);
    }
    uvec2 random = hashed(uvec2(gl_FragCoord.xy));
    vec2 shift = vec2(random >> 8u) / 16777216.0;
    now = vec4(shaded(normal, view, alpha, specular, diffuse, shift), 1.0);
  }
  mean = frame == 0 ? now : mix(texelFetch(previous, ivec2(gl_FragCoord.xy), 0), now, 1.0 / float(frame + 1));
}
