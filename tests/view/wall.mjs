/** A model: a wall of bricks of 1 m x 0.5 m on a held base, let go all at once. Times in s. */
export const wall = ({ columns, rows, duration, every, historyEvery }) => `
  [materials.rock]
  density = 2000.0
  young = 5e9
  poisson = 0.2
  [joints.mortar]
  friction_angle = 30.0
  [[block]]
  fixed = true
  polygon = [[-5, -1], [${columns + 5}, -1], [${columns + 5}, 0], [-5, 0]]
  [[brick_wall]]
  columns = ${columns}
  rows = ${rows}
  brick = [1.0, 0.5]
  [solver]
  duration = ${duration}
  [output]
  every = ${every}
  history_every = ${historyEvery}`;
