// A Core sends the calls of the page to the worker, and returns a promise for each call.
export class Core {
  #worker;
  #waiting = new Map();
  #number = 0;

  constructor(worker) {
    this.#worker = worker;
    worker.onmessage = ({ data: { number, answer, failure } }) => {
      const { done, fail } = this.#waiting.get(number);
      this.#waiting.delete(number);
      if (failure === undefined) done(answer);
      else fail(new Error(failure));
    };
    worker.onerror = (event) => {
      for (const { fail } of this.#waiting.values()) fail(new Error(event.message ?? 'the worker cannot be started'));
      this.#waiting.clear();
    };
  }

  call(call, given, transferred = []) {
    return new Promise((done, fail) => {
      this.#waiting.set(++this.#number, { done, fail });
      this.#worker.postMessage({ call, number: this.#number, ...given }, transferred);
    });
  }
}
