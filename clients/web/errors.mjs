/* errors.mjs - refusals of the renderer. */
export class ZrasterError extends Error {
  /** status: a word such as 'bad-scene'; faults: { pointer, detail } each. */
  constructor(status, message, faults = []) {
    super(message || status);
    this.name = 'ZrasterError';
    this.status = status;
    this.faults = faults;
  }
}
