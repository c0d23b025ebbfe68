#version 330 core
// Corners of triangles as they stand, in place of pyrender's shader of this name: its attributes, and the ball they are on.

layout(location = 0) in vec3 position;
#ifdef TANGENT_LOC
layout(location = TANGENT_LOC) in vec4 tangent;
flat out vec4 ball;
#endif
#ifdef TEXCOORD_0_LOC
layout(location = TEXCOORD_0_LOC) in vec2 texcoord_0;
out vec2 texel;
#endif
layout(location = COLOR_0_LOC) in vec4 color_0;
out vec4 color;
layout(location = INST_M_LOC) in mat4 inst_m;

uniform mat4 M;
uniform mat4 V;
uniform mat4 P;

void main()
{
    gl_Position = P * V * M * inst_m * vec4(position, 1);
#ifdef TANGENT_LOC
    ball = tangent;
#endif
#ifdef TEXCOORD_0_LOC
    texel = texcoord_0;
#endif
    color = color_0;
}
