// Problems of motion, as files of `affinor simulate`; their parameters have sliders.
export const PROBLEMS = {
  "free body": `name   = "free body"
space  = "so3"
metric = "diag(J1, J2, J3)"

[parameters]
J1 = 0.6
J2 = 1
J3 = 1.5
w1 = 0.1
w2 = 2
w3 = 0.1

[initial]
velocity = ["w1", "w2", "w3"]

[integrator]
method = "dmv10"
step   = 0.05

[output]
end   = 30
every = 0.1
`,
  "heavy top": `name   = "heavy top"
space  = "so3"
metric = "diag(J1, J2, J3)"

[parameters]
J1   = 1
J2   = 1
J3   = 0.5
load = 1
w1   = 0.5
w2   = 0
w3   = 6

[initial]
element  = [[1, 0, 0], [0, 0.8, -0.6], [0, 0.6, 0.8]]
velocity = ["w1", "w2", "w3"]

[forces]
potential = "load*R33"

[integrator]
method = "simo-wong"
step   = 0.05

[output]
end   = 20
every = 0.1

[quantities]
vertical = "h3"
`,
  "body in a fluid": `name   = "body in a fluid"
space  = "se3"
metric = "diag(J1, J2, J3, m1, m2, m3)"

[parameters]
J1 = 1
J2 = 2
J3 = 3
m1 = 4
m2 = 2
m3 = 1
w1 = 0.5
w2 = -0.3
w3 = 0.6
v1 = 0.4
v2 = 0.2
v3 = -0.5

[initial]
velocity = ["w1", "w2", "w3", "v1", "v2", "v3"]

[integrator]
method = "rkmk4"
step   = 0.05

[output]
end   = 30
every = 0.1

[quantities]
Pi_P = "H1*H4 + H2*H5 + H3*H6"
P_P  = "H4^2 + H5^2 + H6^2"
`,
};
