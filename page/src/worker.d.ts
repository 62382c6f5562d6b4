// A script bundled on its own, as text (build.mjs).
declare module 'worker:*' {
  const code: string;
  export default code;
}
declare module '*.css' {
  const text: string;
  export default text;
}
